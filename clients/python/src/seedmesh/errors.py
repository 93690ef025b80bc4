"""What a call can raise beside OSError, which says that there is no server."""
from typing import List

from .types import Problem, ProblemErrorsItem


class SeedmeshError(Exception):
    """An answer that is neither a result nor 304."""

    def __init__(self, problem: Problem):
        self.problem = problem
        self.status = problem["status"]
        lines = [line_of(each) for each in self.errors]
        super().__init__("\n".join(lines) or problem.get("detail") or problem["title"])

    @property
    def errors(self) -> List[ProblemErrorsItem]:
        """Every error of the request, each with its pointer; with line and column if it is inside a text."""
        return self.problem.get("errors", [])


class Refused(SeedmeshError):
    """The request is invalid, exceeds a limit, or is not allowed."""


class Busy(SeedmeshError):
    """The server had no time within the patience of the client: 429 or 503."""


def line_of(error: ProblemErrorsItem) -> str:
    """An error as a line of text: pointer, position inside the text, message."""
    position = f":{error['line']}:{error['column']}" if "line" in error and "column" in error else ""
    return f"{error['pointer']}{position}: {error['message']}"
