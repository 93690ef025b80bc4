"""Client of a Seedmesh server, with nothing but Python's standard library.

    import seedmesh
    model = seedmesh.Client().generate({"preset": "oak", "seed": 7})
    model.save("oak.glb")
"""
from .client import AsyncClient, Client, Model
from .errors import Busy, Refused, SeedmeshError
from .types import Problem, Request

__all__ = ["AsyncClient", "Busy", "Client", "Model", "Problem", "Refused", "Request", "SeedmeshError", "fetch"]
__version__ = "0.2.0"


def fetch(request: Request, path: str) -> bool:
    """Keeps the model of `request` in the file `path`, by the server that SEEDMESH_URL names. See Client.fetch."""
    return Client().fetch(request, path)
