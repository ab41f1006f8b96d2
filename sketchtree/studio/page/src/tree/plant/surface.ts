// How does light fall on wood and leaves? three's physical material, with four things of ours written into its shader:
//
//     sky      what the crown leaves of the sky's light at this place (`shade.ts`), on all indirect light; of the sun's too where shadows cost too much
//     passed   light from behind that a leaf lets through, in the colour of its translucency map
//     marks    a colour over chosen limbs (`marks.ts`), or over how doubtful they are
//     leaves   one card at many places, each with its quaternion, scale and tint; cheaper than a matrix each

import { Color, Data3DTexture, DoubleSide, FrontSide, LinearFilter, MeshDepthMaterial, MeshStandardMaterial, RGFormat, ShaderChunk, Vector3, type Texture } from "three";
import type { Material } from "../../messages";
import { MARK_OF, type Marks } from "./marks";
import type { Shade } from "./shade";

type Shader = Parameters<MeshStandardMaterial["onBeforeCompile"]>[0];

export class Sky {
  readonly texture = { value: cube([1, 1, 1], new Uint8Array([255, 255])) };
  readonly low = { value: new Vector3() };
  readonly size = { value: new Vector3(1, 1, 1) };

  take(shade: Shade | null): void {
    this.texture.value.dispose();
    this.texture.value = shade ? cube(shade.cells, shade.light) : cube([1, 1, 1], new Uint8Array([255, 255]));
    this.low.value.set(...(shade?.low ?? [0, 0, 0]));
    this.size.value.set(...(shade?.size ?? [1, 1, 1]));
  }
}

function cube([x, y, z]: [number, number, number], light: Uint8Array<ArrayBuffer>): Data3DTexture {
  const texture = new Data3DTexture(light, x, y, z);
  texture.format = RGFormat;
  texture.unpackAlignment = 1;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export interface Lighting {
  sky: Sky;
  marks: Marks;
  doubt: { value: number }; // 1: limbs wear the colour of how sure their depth is
  sunByGrid: boolean; // wood learns from the grid how much sun is left, not from a shadow map; leaves always do: softer than a shadow of each on each
  leafShare: { value: number }; // how many of the leaves are there: fewer while wood is chosen or looked at
}

const DARKEST = 0.42; // of the sky's light, in the deepest crown: leaves hand it on to each other
const PLACED = `
attribute vec3 aPlace; attribute vec4 aTurn; attribute vec3 aScale; attribute vec3 aTint;
vec3 turned(vec3 p) { vec4 q = normalize(aTurn); return p + 2.0 * cross(q.xyz, cross(q.xyz, p) + q.w * p); }
`;
const PLACED_NORMAL = "vec3 objectNormal = normalize(turned(normal / aScale));";
const PLACED_POINT = "vec3 transformed = aPlace + turned(aScale * position);";
const THINNED = "if (fract(float(gl_InstanceID) * 0.618034) >= uLeafShare) transformed = aPlace;"; // all its corners at one point: not drawn
const SKY = "uniform sampler3D uSky; uniform vec3 uSkyLow; uniform vec3 uSkySize; uniform float uSunByGrid; uniform float uLeafShare; varying vec2 vSky;\n";
const SKY_IN = "varying vec2 vSky;\n";
const SKY_AT = `vSky = mix(vec2(${DARKEST}, 1.0 - uSunByGrid), vec2(1.0), texture(uSky, (transformed - uSkyLow) / uSkySize).rg);
vSky = mix(vec2(1.0), vSky, 0.25 + 0.75 * uLeafShare);`; // what is hidden shades little
/** With the sky's own gleam on bark and leaves: neutral tone mapping takes as much away (0.04), and where there was none the dark becomes too deep and too gaudy. */
const SKY_FALLS = "#include <aomap_fragment>\nreflectedLight.indirectDiffuse *= vSky.x; reflectedLight.directDiffuse *= vSky.y; reflectedLight.directSpecular *= vSky.y;\n"
  + "reflectedLight.indirectSpecular += 0.04 * RECIPROCAL_PI * irradiance * vSky.x;";

/** three's own edge begins at the cut and lies inside the drawing, so that far leaves, all edge, are thinned; this one lies across it. */
const COVERED = `
#ifdef USE_ALPHATEST
  diffuseColor.a = saturate((diffuseColor.a - alphaTest) / clamp(fwidth(diffuseColor.a), 1e-3, 0.3) + 0.5);
  if (diffuseColor.a == 0.0) discard;
#endif`;

/** Joints make wood long before they make it thick: three turns normals as if both were alike, and thin shoots would be dark. Cofactors turn them truly, and are finite where a size is 0. */
const GROWN_NORMAL = `#include <skinnormal_vertex>
#ifdef USE_SKINNING
  objectNormal = mat3(cross(skinMatrix[1].xyz, skinMatrix[2].xyz), cross(skinMatrix[2].xyz, skinMatrix[0].xyz), cross(skinMatrix[0].xyz, skinMatrix[1].xyz)) * restNormal;
#endif`;

function grownNormal(vertexShader: string): string {
  return vertexShader.replace("#include <skinnormal_vertex>", `vec3 restNormal = objectNormal;\n${GROWN_NORMAL}`);
}

/** The material of a part that is drawn once: wood. Its mesh has the attributes `limb` and `doubt` (rgb, 1 a vertex). */
export function woodMaterial(of: Material, lighting: Lighting): MeshStandardMaterial {
  const material = standard(of);
  material.onBeforeCompile = (shader) => {
    share(shader, lighting, lighting.sunByGrid);
    shader.uniforms.uMarks = lighting.marks.uniform;
    shader.uniforms.uDoubt = lighting.doubt;
    shader.vertexShader = `attribute float limb; attribute vec3 doubt; uniform sampler2D uMarks; varying vec4 vMark; varying vec3 vDoubt;\n${MARK_OF}\n${SKY}`
      + grownNormal(shader.vertexShader).replace("#include <begin_vertex>", `#include <begin_vertex>\n${SKY_AT} vMark = markOf(limb); vDoubt = doubt;`);
    shader.fragmentShader = `uniform float uDoubt; varying vec4 vMark; varying vec3 vDoubt; ${SKY_IN}`
      + shader.fragmentShader.replace("#include <aomap_fragment>", SKY_FALLS)
        .replace("#include <map_fragment>", "#include <map_fragment>\ndiffuseColor.rgb = mix(diffuseColor.rgb, vDoubt, uDoubt);")
        .replace("#include <opaque_fragment>", "outgoingLight = mix(outgoingLight, vMark.rgb * (0.35 + outgoingLight), vMark.a);\n#include <opaque_fragment>");
  };
  return material;
}

/** The material of a card that is drawn at many places, or `baked` into one mesh. `sampled`: a pixel has several samples, which its edge may cover. */
export function leafMaterial(of: Material, lighting: Lighting, passing: { value: Texture | null }, isBaked: boolean, sampled: boolean): MeshStandardMaterial {
  const material = standard(of);
  material.alphaToCoverage = of.cutoff !== null && sampled;
  material.onBeforeCompile = (shader) => {
    share(shader, lighting, true);
    shader.uniforms.uPassing = passing;
    shader.uniforms.uPasses = { value: of.translucency };
    shader.vertexShader = `varying vec3 vTint; ${isBaked ? "attribute vec3 aTint;" : PLACED}\n${SKY}` + grownNormal(shader.vertexShader)
      .replace("#include <beginnormal_vertex>", isBaked ? "#include <beginnormal_vertex>" : PLACED_NORMAL)
      .replace("#include <begin_vertex>", `${isBaked ? "#include <begin_vertex>" : PLACED_POINT + THINNED}\nvTint = aTint; ${SKY_AT}`);
    shader.fragmentShader = `varying vec3 vTint; uniform float uPasses; uniform sampler2D uPassing; vec3 passed; ${SKY_IN}`
      + shader.fragmentShader
        .replace("#include <lights_physical_pars_fragment>", passingLight(ShaderChunk.lights_physical_pars_fragment))
        .replace("#include <aomap_fragment>", SKY_FALLS)
        .replace("#include <alphatest_fragment>", sampled ? COVERED : "#include <alphatest_fragment>")
        .replace("#include <map_fragment>", `#include <map_fragment>\ndiffuseColor.rgb *= vTint;
#ifdef USE_MAP
passed = uPasses * vTint * texture2D(uPassing, vMapUv).rgb;
#else
passed = vec3(0.0);
#endif`);
  };
  return material;
}

/** The shadow of such a card: its drawing, not its corners. */
export function leafShadow(of: Material, isBaked: boolean): MeshDepthMaterial {
  const material = new MeshDepthMaterial({ side: DoubleSide, alphaTest: of.cutoff ?? 0 });
  if (isBaked) return material;
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = PLACED + shader.vertexShader.replace("#include <begin_vertex>", PLACED_POINT);
  };
  return material;
}

function standard(of: Material): MeshStandardMaterial {
  return new MeshStandardMaterial({
    name: of.key, roughness: of.roughness, metalness: 0, side: of.double_sided ? DoubleSide : FrontSide, alphaTest: of.cutoff ?? 0,
    color: new Color().setRGB(of.color[0]!, of.color[1]!, of.color[2]!),
  });
}

function share(shader: Shader, { sky, leafShare }: Lighting, sunByGrid: boolean): void {
  Object.assign(shader.uniforms, { uSky: sky.texture, uSkyLow: sky.low, uSkySize: sky.size, uLeafShare: leafShare, uSunByGrid: { value: sunByGrid ? 1 : 0 } });
}

/** three's direct light, and after it what comes through from the other side. */
function passingLight(chunk: string): string {
  return chunk.replace(/#define RE_Direct\s+RE_Direct_Physical/, `
void directAndPassed(const in IncidentLight light, const in vec3 at, const in vec3 facing, const in vec3 toEye, const in vec3 coat, const in PhysicalMaterial material, inout ReflectedLight reflected) {
  RE_Direct_Physical(light, at, facing, toEye, coat, material, reflected);
  reflected.directDiffuse += passed * light.color * saturate(0.15 - 0.85 * dot(facing, light.direction)) * RECIPROCAL_PI;
}
#define RE_Direct directAndPassed`);
}
