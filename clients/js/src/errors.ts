import type { Problem, ProblemErrorsItem } from './types.js';

/** An answer that is no result. Without a server, calls fail with the TypeError of fetch. */
export class SeedmeshError extends Error {
  readonly problem: Problem;
  readonly status: number;

  constructor(problem: Problem) {
    super((problem.errors ?? []).map(line_of).join('\n') || problem.detail || problem.title);
    this.name = new.target.name;
    this.problem = problem;
    this.status = problem.status;
  }

  /** Every error of the request, each with its pointer; with line and column if it is inside a text. */
  get errors(): ProblemErrorsItem[] { return this.problem.errors ?? []; }
}

/** The request is invalid, exceeds a limit, or is not allowed. */
export class Refused extends SeedmeshError {}

/** The server had no time within the patience of the client: 429 or 503. */
export class Busy extends SeedmeshError {}

function line_of(error: ProblemErrorsItem): string {
  const position = error.line === undefined ? '' : `:${error.line}:${error.column ?? 1}`;
  return `${error.pointer}${position}: ${error.message}`;
}

/** The error of an answer; answers of proxies have no problem body. */
export async function error_of(response: Response): Promise<SeedmeshError> {
  const is_problem = response.headers.get('content-type')?.startsWith('application/problem+json') ?? false;
  const problem: Problem = is_problem
    ? await response.json() as Problem
    : { type: 'about:blank', title: response.statusText, status: response.status, detail: `HTTP status ${response.status}` };
  return new (is_busy(response.status) ? Busy : Refused)(problem);
}

export const is_busy = (status: number): boolean => status === 429 || status === 503;
