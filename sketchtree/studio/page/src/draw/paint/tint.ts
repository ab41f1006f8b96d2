// The foliage of the photo as a picture of one colour: what the program says of it is a mask.

/** The mask's opaque pixels in that colour; null: there is none, or it can't be read. */
export async function tinted(base64: string, colour: string): Promise<OffscreenCanvas | null> {
  if (base64 === "") return null;
  try {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const mask = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const made = new OffscreenCanvas(mask.width, mask.height);
    const on = made.getContext("2d");
    if (!on) return null;
    on.drawImage(mask, 0, 0);
    mask.close();
    on.globalCompositeOperation = "source-in";
    on.fillStyle = colour;
    on.fillRect(0, 0, made.width, made.height);
    return made;
  } catch {
    return null;
  }
}
