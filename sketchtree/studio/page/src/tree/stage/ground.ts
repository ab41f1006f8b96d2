// What does the tree stand on? A round of plain ground that fades into the horizon, with the sun's shadow on it, a soft darkening below the crown and at the
// trunk's foot, and lines a metre apart when somebody wants to measure.

import { Box3, CircleGeometry, Color, Mesh, ShaderMaterial, UniformsLib, UniformsUtils, Vector2, type Scene } from "three";
import { DITHER, LOOKS } from "./weather";

export class Ground {
  private readonly mesh: Mesh<CircleGeometry, ShaderMaterial>;

  constructor(scene: Scene) {
    this.mesh = new Mesh(new CircleGeometry(1, 96).rotateX(-Math.PI / 2), material());
    this.mesh.receiveShadow = true;
    this.mesh.renderOrder = -5;
    scene.add(this.mesh);
    this.wear("light");
  }

  wear(theme: "light" | "dark"): void {
    const look = LOOKS[theme];
    const uniforms = this.mesh.material.uniforms;
    uniforms.uGround!.value.set(look.ground);
    uniforms.uShadow!.value.set(look.shadow);
    uniforms.uHorizon!.value.set(look.horizon);
    uniforms.uLine!.value = theme === "light" ? 0.8 : 1.7;
  }

  /** As wide as this tree needs. `trunk`: its radius, metres. */
  under(box: Box3, trunk: number): void {
    const reach = 26 * Math.max(box.max.y, box.max.x - box.min.x, box.max.z - box.min.z, 1);
    this.mesh.scale.setScalar(reach);
    const uniforms = this.mesh.material.uniforms;
    uniforms.uReach!.value = reach;
    uniforms.uCrown!.value = Math.max(0.3, 0.5 * Math.max(box.max.x - box.min.x, box.max.z - box.min.z));
    uniforms.uTrunk!.value = Math.max(trunk, 0.02);
    uniforms.uMiddle!.value.set((box.max.x + box.min.x) / 2, (box.max.z + box.min.z) / 2);
  }

  grid(is: boolean): void {
    this.mesh.material.uniforms.uGrid!.value = is ? 1 : 0;
  }

  /** Nothing stands on it: nothing darkens it. */
  set bare(is: boolean) {
    this.mesh.material.uniforms.uStands!.value = is ? 0 : 1;
  }

  set visible(is: boolean) {
    this.mesh.visible = is;
  }
}

function material(): ShaderMaterial {
  return new ShaderMaterial({
    lights: true, toneMapped: false,
    uniforms: UniformsUtils.merge([UniformsLib.lights, {
      uGround: { value: new Color() }, uShadow: { value: new Color() }, uHorizon: { value: new Color() }, uReach: { value: 1 }, uCrown: { value: 1 }, uTrunk: { value: 0.2 },
      uMiddle: { value: new Vector2() }, uStands: { value: 1 }, uGrid: { value: 0 }, uLine: { value: 1 },
    }]),
    vertexShader: `
      #include <common>
      #include <shadowmap_pars_vertex>
      varying vec3 vAt;
      void main() {
        #include <beginnormal_vertex>
        #include <defaultnormal_vertex>
        #include <begin_vertex>
        vec4 worldPosition = modelMatrix * vec4(position, 1.0);
        vAt = worldPosition.xyz;
        #include <shadowmap_vertex>
        gl_Position = projectionMatrix * viewMatrix * worldPosition;
      }`,
    fragmentShader: `
      #include <common>
      #include <packing>
      #include <lights_pars_begin>
      #include <shadowmap_pars_fragment>
      #include <shadowmask_pars_fragment>
      uniform vec3 uGround, uShadow, uHorizon; uniform float uStands, uReach, uCrown, uTrunk, uGrid, uLine; uniform vec2 uMiddle; varying vec3 vAt;
      float line(float at, float wide) { float d = abs(fract(at - 0.5) - 0.5) / max(fwidth(at), 1e-5); return (1.0 - smoothstep(0.0, wide, d)) * (1.0 - smoothstep(0.2, 0.6, fwidth(at))); }
      void main() {
        float far = length(vAt.xz) / uReach;
        float below = exp(-dot(vAt.xz - uMiddle, vAt.xz - uMiddle) / (0.9 * uCrown * uCrown));
        float foot = exp(-pow(max(length(vAt.xz) - uTrunk, 0.0) / (1.6 * uTrunk), 1.0));
        float light = mix(0.42, 1.0, getShadowMask()) * (1.0 - 0.16 * uStands * below) * (1.0 - 0.45 * uStands * foot);
        vec3 color = mix(uShadow, uGround, light);
        float grid = uGrid * max(line(vAt.x, 1.2), line(vAt.z, 1.2)) * exp(-length(vAt.xz) / (3.0 * uCrown));
        color = mix(color, color * (uLine < 1.0 ? 0.62 : 1.7), grid);
        gl_FragColor = vec4(mix(color, uHorizon, smoothstep(0.04, 0.42, far)), 1.0);
        #include <colorspace_fragment>
        ${DITHER}
      }`,
  });
}
