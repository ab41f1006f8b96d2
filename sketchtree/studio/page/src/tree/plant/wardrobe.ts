// What does each material of the plant wear? A surface made once, which gets its maps as they come.

import type { MeshStandardMaterial, Texture } from "three";
import type { Material } from "../../messages";
import { leafMaterial, leafShadow, woodMaterial, type Lighting } from "./surface";
import type { MapKind, Textures } from "./textures";

const BARE = "#7d6c59"; // wood whose bark is still on its way

/** wood; a leaf's card drawn at many places; or leaves whose corners are written out into one mesh. */
export type Cut = "wood" | "placed" | "baked";

export interface Worn {
  of: string; // the material as the frame said it, to see whether it is another now
  surface: MeshStandardMaterial;
  shadow: ReturnType<typeof leafShadow> | null;
}

export class Wardrobe {
  private readonly worn = new Map<string, Worn>();

  /** `changed`: a map came. */
  constructor(private readonly lighting: Lighting, private readonly textures: Textures, private readonly software: boolean, private readonly changed: () => void) {}

  wear(of: Material, cut: Cut): Worn {
    const name = `${cut} ${of.key}`;
    const said = JSON.stringify(of);
    const had = this.worn.get(name);
    if (had?.of === said) return had;
    const passing: { value: Texture | null } = { value: null };
    const surface = cut === "wood" ? woodMaterial(of, this.lighting) : leafMaterial(of, this.lighting, passing, cut === "baked", !this.software);
    const shadow = cut === "wood" ? null : leafShadow(of, cut === "baked");
    surface.customProgramCacheKey = () => cut;
    shadow && (shadow.customProgramCacheKey = () => `${cut} shadow`);
    const worn = { of: said, surface, shadow };
    this.worn.set(name, worn);
    this.dress(of, worn, passing);
    return worn;
  }

  /** Nothing is worn any more; the maps stay. */
  clear(): void {
    for (const { surface, shadow } of this.worn.values()) {
      surface.dispose();
      shadow?.dispose();
    }
    this.worn.clear();
  }

  private dress(of: Material, { surface, shadow }: Worn, passing: { value: Texture | null }): void {
    const put: Record<MapKind, (map: Texture) => void> = {
      color: (map) => { surface.map = map; surface.color.setRGB(of.color[0]!, of.color[1]!, of.color[2]!); if (shadow) { shadow.map = map; shadow.needsUpdate = true; } },
      normal: (map) => { surface.normalMap = map; },
      roughness: (map) => { surface.roughnessMap = map; surface.roughness = 1; },
      translucency: (map) => { passing.value = map; },
    };
    if (shadow) surface.visible = false; // until its colours are there: cards without them are squares
    else if (of.maps.includes("color")) surface.color.set(BARE); // wood stands at once, as plain wood
    const shown = (): void => {
      surface.visible = surface.needsUpdate = true;
      this.changed();
    };
    const worth = this.software && shadow ? ["color", "translucency"] : of.maps; // a leaf's veins are not worth their time there
    const bring = (kind: MapKind): Promise<void> => this.textures.get(of.key, kind, of.cutoff).then((map) => put[kind](map));
    const kinds = (of.maps as MapKind[]).filter((kind) => worth.includes(kind));
    const first = kinds.filter((kind) => kind === "color").map((kind) => bring(kind).then(shown));
    void Promise.allSettled([...first, ...kinds.filter((kind) => kind !== "color").map(bring)]).then(shown); // of what the program has not, the plain colour stays
  }
}
