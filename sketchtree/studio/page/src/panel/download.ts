// How does something made here become a file of the user's? Saved by the browser, under a name.

export function download(contents: Blob, name: string): void {
  const address = URL.createObjectURL(contents);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 60_000); // a slow disk still reads from it
}

/** The name that the program gave its answer, or this one. */
export function nameOf(answer: Response, otherwise: string): string {
  const header = answer.headers.get("content-disposition") ?? "";
  const encoded = /filename\*=utf-8''([^;]+)/i.exec(header)?.[1];
  if (encoded) {
    try {
      return decodeURIComponent(encoded);
    } catch {
      return otherwise;
    }
  }
  return /filename="([^"]+)"/i.exec(header)?.[1] ?? otherwise;
}
