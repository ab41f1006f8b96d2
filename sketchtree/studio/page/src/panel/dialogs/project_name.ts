// Is this a name for a project file? With its extension, or what is wrong with it.

export const EXTENSION = ".sketchtree";
const LONGEST = 120;

export function projectName(typed: string): { name: string } | { wrong: string } {
  const bare = typed.trim().replace(/\.sketchtree$/i, "").trim();
  if (bare === "") return { wrong: "Give it a name." };
  if (/[/\\]/.test(bare)) return { wrong: "A name has no / and no \\; it is saved in the studio's folder." };
  if (/[\u0000-\u001f\u007f]/.test(bare)) return { wrong: "This name has characters that no file can have." };
  if (bare.startsWith(".")) return { wrong: "A name that starts with a point would be hidden." };
  const name = bare + EXTENSION;
  return name.length > LONGEST ? { wrong: `That is too long: at most ${LONGEST - EXTENSION.length} letters.` } : { name };
}
