// Where do a material's maps come from? From the program, one PNG each, fetched once; until one is there the material has its colour only.

import { DataTexture, LinearMipmapLinearFilter, LinearFilter, NoColorSpace, RepeatWrapping, SRGBColorSpace, Texture } from "three";
import { mipmaps } from "./coverage";

export type MapKind = "color" | "normal" | "roughness" | "translucency";

const IS_COLOUR: Record<MapKind, boolean> = { color: true, normal: false, roughness: false, translucency: true };

export class Textures {
  private readonly known = new Map<string, Promise<Texture>>();

  /** `address` of a material's map; the widget in a notebook has others than the studio. */
  constructor(private readonly address: (key: string, kind: MapKind) => string, private readonly anisotropy: number) {}

  /** The map, once it is there. `cut`: alpha below it is not drawn, so that smaller pictures keep their coverage. Rejects where the program has none. */
  get(key: string, kind: MapKind, cut: number | null): Promise<Texture> {
    const name = `${key}/${kind}`;
    if (!this.known.has(name)) {
      const loading = this.load(key, kind, cut);
      loading.catch(() => this.known.delete(name)); // the next frame that names it asks again
      this.known.set(name, loading);
    }
    return this.known.get(name)!;
  }

  private async load(key: string, kind: MapKind, cut: number | null): Promise<Texture> {
    const answer = await fetch(this.address(key, kind));
    if (!answer.ok) throw new Error(`There is no ${kind} map of ${key}.`);
    const picture = await createImageBitmap(await answer.blob(), { premultiplyAlpha: "none", colorSpaceConversion: "none" });
    const texture = kind === "color" && cut !== null ? covering(picture, cut) : plain(picture);
    texture.colorSpace = IS_COLOUR[kind] ? SRGBColorSpace : NoColorSpace;
    texture.wrapS = texture.wrapT = RepeatWrapping;
    texture.anisotropy = this.anisotropy;
    texture.flipY = false; // glTF's uv: (0, 0) is the top left
    texture.needsUpdate = true;
    return texture;
  }
}

function plain(picture: ImageBitmap): Texture {
  const texture = new Texture(picture);
  texture.minFilter = LinearMipmapLinearFilter;
  return texture;
}

function covering(picture: ImageBitmap, cut: number): Texture {
  const { width, height } = picture;
  const canvas = new OffscreenCanvas(width, height);
  const brush = canvas.getContext("2d", { willReadFrequently: true })!;
  brush.drawImage(picture, 0, 0);
  const data = new Uint8Array(brush.getImageData(0, 0, width, height).data.buffer);
  const texture = new DataTexture(data, width, height);
  texture.mipmaps = mipmaps({ width, height, data }, cut);
  texture.generateMipmaps = false;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  return texture;
}
