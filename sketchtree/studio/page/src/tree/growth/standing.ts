// How does a tree that grows stand in the scene? Its parts as skinned meshes that share one table of matrices; another moment is another table, and nothing else.

import { BufferAttribute, BufferGeometry, DataTexture, Group, RGBAFormat, FloatType, Skeleton, SkinnedMesh, Sphere, Vector3, type MeshStandardMaterial } from "three";
import type { Worn } from "../plant/wardrobe";
import { moved, type Growth, type GrowthPart } from "./growth";
import { leafwise } from "./leafwise";
import { Pose } from "./pose";

/** What a part wears, by the name of its material; null: nothing that is known here. */
export type Wears = (material: string, isLeaf: boolean) => Worn | null;

/** A skeleton without bones: thousands of objects would cost more than all their matrices. */
class Table extends Skeleton {
  constructor(joints: number) {
    super([]);
    const side = Math.max(4, 4 * Math.ceil(Math.sqrt(4 * joints) / 4)); // four texels a joint, and whole joints a row
    this.boneMatrices = new Float32Array(4 * side * side);
    this.boneTexture = new DataTexture(this.boneMatrices, side, side, RGBAFormat, FloatType);
    this.boneTexture.needsUpdate = true;
  }

  override update(): void {} // three would ask the bones
}

export class Standing {
  readonly group = new Group();
  leafShare = 0; // of the leaves that are out
  private readonly pose: Pose;
  private readonly table: Table;
  private readonly parts: { mesh: SkinnedMesh<BufferGeometry, MeshStandardMaterial>; part: GrowthPart; corners: number }[] = [];

  constructor(private readonly growth: Growth, wears: Wears, software: boolean) {
    this.pose = new Pose(growth.joints, growth.moves);
    this.table = new Table(growth.joints.parent.length);
    const reach = reachOf(growth.parts);
    for (const part of growth.parts) {
      const worn = wears(part.material, part.fold !== null);
      if (!worn) continue;
      const corners = part.fold && software ? leafwise(part.index) : 0;
      const mesh = new SkinnedMesh(geometryOf(part), worn.surface);
      mesh.bindMode = "detached"; // the matrices take it to its place in the scene
      mesh.skeleton = this.table;
      mesh.customDepthMaterial = worn.shadow ?? undefined;
      mesh.castShadow = true;
      mesh.receiveShadow = !software && part.fold === null;
      mesh.frustumCulled = mesh.matrixAutoUpdate = false;
      mesh.boundingSphere = reach;
      if (part.fold) mesh.morphTargetInfluences = [0];
      this.group.add(mesh);
      this.parts.push({ mesh, part, corners });
    }
  }

  /** As it is at that share of its time. */
  at(share: number): void {
    const second = share * this.growth.seconds;
    this.pose.at(second, this.table.boneMatrices as Float32Array);
    this.table.boneTexture!.needsUpdate = true;
    let [out, all] = [0, 0];
    for (const { mesh, part } of this.parts) {
      if (!part.fold) continue;
      const share = (mesh.morphTargetInfluences![0] = moved(part.fold, second));
      const open = part.fold.restsOut ? 1 - share : share;
      mesh.visible = open > 0; // a leaf that is all at its foot is none
      if (!part.fold.restsOut) continue; // a young tree's few shade nothing
      out += open * part.index.length;
      all += part.index.length;
    }
    this.leafShare = all ? out / all : 0;
  }

  /** Draw this share of the leaves. */
  thin(share: number): void {
    for (const { mesh, corners } of this.parts) {
      if (corners) mesh.geometry.setDrawRange(0, share >= 1 ? Infinity : corners * Math.ceil((share * mesh.geometry.index!.count) / corners));
    }
  }

  get triangles(): number {
    return this.growth.parts.reduce((sum, part) => sum + part.index.length / 3, 0);
  }

  dispose(): void {
    for (const { mesh } of this.parts) mesh.geometry.dispose();
    this.table.dispose();
    this.group.removeFromParent();
  }
}

function geometryOf(part: GrowthPart): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(part.position, 3));
  geometry.setAttribute("normal", new BufferAttribute(part.normal, 3));
  geometry.setAttribute("uv", new BufferAttribute(part.uv, 2));
  geometry.setAttribute("skinIndex", new BufferAttribute(part.joint, 4));
  geometry.setAttribute("skinWeight", new BufferAttribute(part.weight, 4, !(part.weight instanceof Float32Array)));
  if (part.fold) {
    geometry.setAttribute("aTint", new BufferAttribute(part.tint ?? new Uint8Array((4 * part.position.length) / 3).fill(255), 4, true));
    geometry.morphAttributes.position = [new BufferAttribute(part.fold.way, 3)];
    geometry.morphTargetsRelative = true;
  }
  geometry.setIndex(new BufferAttribute(part.index, 1));
  return geometry;
}

/** A ball round all there is. */
function reachOf(parts: GrowthPart[]): Sphere {
  let far = 1;
  for (const { position } of parts) for (let k = 0; k < position.length; k++) far = Math.max(far, Math.abs(position[k]!));
  return new Sphere(new Vector3(), 2 * far);
}
