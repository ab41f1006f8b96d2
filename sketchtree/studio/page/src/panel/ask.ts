// How does the page ask the program for files? By HTTP on its own origin; what goes wrong comes back as a cause and a remedy, in the same words as elsewhere.

export class Refused extends Error {
  constructor(message: string, readonly remedy: string, readonly trees: readonly string[] = []) { // trees: of which one has to be chosen
    super(message);
  }
}

const GONE = new Refused("The studio does not answer.", "Start it again in the terminal; your drawing is kept.");

/** GET or POST; an answer that is no success becomes `Refused`. Cancelling by `signal` passes through as it is. */
export async function ask(address: string, init: RequestInit = {}): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(address, { credentials: "same-origin", ...init });
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw GONE;
  }
  if (!answer.ok) throw await refusal(answer);
  return answer;
}

async function refusal(answer: Response): Promise<Refused> {
  const said: unknown = await answer.json().catch(() => null);
  if (isCause(said)) return new Refused(said.message, said.remedy, said.trees);
  return new Refused(`The studio refused this (${answer.status}).`, "Reload the page; if it happens again, start the studio again.");
}

function isCause(said: unknown): said is { message: string; remedy: string; trees?: string[] } {
  if (typeof said !== "object" || said === null || !("message" in said) || !("remedy" in said)) return false;
  return typeof said.message === "string" && typeof said.remedy === "string";
}
