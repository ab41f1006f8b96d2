// What of the plant stands in the scene? A mesh a material of wood, a mesh a card of leaves; made anew from what frames brought.

import { BufferAttribute, BufferGeometry, Box3, Group, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, MeshStandardMaterial, Sphere } from "three";
import type { Material } from "../../messages";
import { baked, type BakedLeaves } from "./bake";
import { merged, type Merged, type MergedLeaves, type MergedWood } from "./merge";
import type { CardShape, Plant } from "./plant";
import { spotsOf } from "./spots";
import { SUN } from "../stage/weather";
import { shadeOf } from "./shade";
import type { Lighting } from "./surface";
import type { Wardrobe } from "./wardrobe";

export class Scenery {
  readonly group = new Group();
  readonly box = new Box3();
  spots: Float32Array = new Float32Array(); // places of what stands
  now: Merged = { wood: [], leaves: [], limbs: [], number: new Map() };
  private shaded = false;
  private worn: Material[] = []; // by what stands

  constructor(private readonly lighting: Lighting, private readonly wardrobe: Wardrobe, private readonly software: boolean, private readonly changed: () => void) {}

  /** Show this plant, where it was another. `quick`: the crown's shade may stay as it was for the moment. */
  show(plant: Plant, quick: boolean): void {
    this.now = merged(plant);
    const names = [...this.now.wood.map((wood) => wood.material), ...this.now.leaves.map((leaves) => plant.cards.get(leaves.card)!.material)];
    this.worn = [...new Set(names)].map((name) => plant.materials.get(name)!);
    this.spots = spotsOf(this.now);
    this.lighting.marks.renumber(this.now.limbs, this.now.number);
    if (!quick || !this.shaded) this.lighting.sky.take(shadeOf(this.now.leaves, SUN.toArray()));
    this.shaded = this.now.leaves.length > 0;
    for (const mesh of this.meshes) mesh.geometry.dispose();
    this.group.clear();
    this.box.makeEmpty();
    for (const wood of this.now.wood) this.add(this.woodMesh(wood, plant));
    for (const leaves of this.now.leaves) if (leaves.count) this.add(this.leafMesh(leaves, plant));
    this.changed();
  }

  /** The colour of every vertex of the wood where doubt is shown: 3 a vertex, of 255, one array a mesh of `now.wood`. */
  doubt(colours: Uint8Array[] | null): void {
    this.lighting.doubt.value = colours ? 1 : 0;
    this.woodMeshes.forEach((mesh, k) => { if (colours) mesh.geometry.setAttribute("doubt", new BufferAttribute(colours[k]!, 3, true)); });
    this.changed();
  }

  /** Draw this share of the leaves, where they are baked; elsewhere the shader leaves them out. Their shadow is always that of all. */
  thin(share: number): void {
    for (const { geometry } of this.meshes) {
      const { corners } = geometry.userData;
      if (corners) geometry.setDrawRange(0, share >= 1 ? Infinity : corners * Math.floor((share * geometry.index!.count) / corners));
    }
  }

  /** What the part of a file wears here, by the name of its material; that of leaves is told apart here by their season too. */
  materialOf(name: string): Material | undefined {
    return this.worn.find((one) => one.key === name || one.key.startsWith(`${name}.`));
  }

  get meshes(): Mesh<BufferGeometry, MeshStandardMaterial>[] {
    return this.group.children as Mesh<BufferGeometry, MeshStandardMaterial>[];
  }

  private get woodMeshes(): Mesh<BufferGeometry, MeshStandardMaterial>[] {
    return this.meshes.filter((mesh) => mesh.userData.wood);
  }

  private add(mesh: Mesh): void {
    mesh.castShadow = true;
    mesh.receiveShadow = !this.software && mesh.userData.wood === true;
    mesh.matrixAutoUpdate = false;
    mesh.geometry.boundingBox ??= new Box3();
    this.box.union(mesh.geometry.boundingBox);
    mesh.geometry.boundingSphere = mesh.geometry.boundingBox.getBoundingSphere(new Sphere());
    this.group.add(mesh);
  }

  private woodMesh(wood: MergedWood, plant: Plant): Mesh {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(wood.position, 3));
    geometry.setAttribute("normal", new BufferAttribute(wood.normal, 4, true));
    geometry.setAttribute("uv", new BufferAttribute(wood.uv, 2));
    geometry.setAttribute("limb", new BufferAttribute(wood.limb, 1));
    geometry.setIndex(new BufferAttribute(wood.index, 1));
    geometry.computeBoundingBox();
    const mesh = new Mesh(geometry, this.wardrobe.wear(plant.materials.get(wood.material)!, "wood").surface);
    mesh.userData.wood = true;
    return mesh;
  }

  private leafMesh(leaves: MergedLeaves, plant: Plant): Mesh {
    const card = plant.cards.get(leaves.card)!;
    const geometry = this.software ? bakedGeometry(baked(leaves, card)) : placedGeometry(leaves, card);
    geometry.boundingBox = new Box3().setFromArray(leaves.place).expandByScalar(Math.max(...leaves.scale.subarray(0, 3)));
    const worn = this.wardrobe.wear(plant.materials.get(card.material)!, this.software ? "baked" : "placed");
    const mesh = new Mesh(geometry, worn.surface);
    mesh.customDepthMaterial = worn.shadow ?? undefined;
    let shown = Infinity;
    mesh.onBeforeShadow = () => { shown = geometry.drawRange.count; geometry.setDrawRange(0, Infinity); };
    mesh.onAfterShadow = () => geometry.setDrawRange(0, shown);
    return mesh;
  }
}

function placedGeometry(leaves: MergedLeaves, card: CardShape): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(card.position, 3));
  geometry.setAttribute("normal", new BufferAttribute(card.normal, 3));
  geometry.setAttribute("uv", new BufferAttribute(card.uv, 2));
  geometry.setIndex(new BufferAttribute(card.index, 1));
  geometry.setAttribute("aPlace", new InstancedBufferAttribute(leaves.place, 3));
  geometry.setAttribute("aTurn", new InstancedBufferAttribute(leaves.turn, 4, true));
  geometry.setAttribute("aScale", new InstancedBufferAttribute(leaves.scale, 3));
  geometry.setAttribute("aTint", new InstancedBufferAttribute(leaves.tint, 3, true));
  geometry.instanceCount = leaves.count;
  return geometry;
}

function bakedGeometry(leaves: BakedLeaves): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(leaves.position, 3));
  geometry.setAttribute("normal", new BufferAttribute(leaves.normal, 4, true));
  geometry.setAttribute("uv", new BufferAttribute(leaves.uv, 2));
  geometry.setAttribute("aTint", new BufferAttribute(leaves.tint, 4, true));
  geometry.setIndex(new BufferAttribute(leaves.index, 1));
  geometry.userData.corners = leaves.corners;
  return geometry;
}
