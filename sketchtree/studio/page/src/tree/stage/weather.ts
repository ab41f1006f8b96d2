// What sky is over the tree, and where does the sun stand? A gradient made by code, its light from all sides, and one sun with a shadow.

import { BackSide, Box3, Color, DirectionalLight, HemisphereLight, Mesh, ShaderMaterial, SphereGeometry, Sphere, Vector3, type Scene } from "three";

export interface Look {
  zenith: string;
  horizon: string;
  ground: string; // its colour in the light
  shadow: string; // its colour where no light comes
  sky: number; // strength of the light from all sides
  sun: number;
  warmth: string; // of the sun
}

export const LOOKS: Record<"light" | "dark", Look> = {
  light: { zenith: "#a9c3da", horizon: "#eceee9", ground: "#dad8d0", shadow: "#4d4f4c", sky: 4.3, sun: 5.8, warmth: "#fff3e2" },
  dark: { zenith: "#1a2733", horizon: "#3a4246", ground: "#363b3c", shadow: "#0f1213", sky: 4.4, sun: 5.8, warmth: "#fff0d8" },
};

/** Half a step of noise: without it a soft gradient shows bands. */
export const DITHER = "gl_FragColor.rgb += (fract(52.98 * fract(dot(gl_FragCoord.xy, vec2(0.0671, 0.00584)))) - 0.5) / 255.0;";

/** Towards the sun: over the left shoulder of who looks from the front. */
export const SUN = new Vector3(-0.52, 0.74, 0.46).normalize();

export class Weather {
  private readonly sun = new DirectionalLight();
  private readonly sky = new HemisphereLight();
  private readonly dome: Mesh<SphereGeometry, ShaderMaterial>;

  constructor(scene: Scene, software: boolean) {
    const side = software ? 1024 : 2048;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(side, side);
    this.sun.shadow.radius = 3.5;
    this.dome = new Mesh(new SphereGeometry(1, 24, 16), domeMaterial());
    this.dome.frustumCulled = false;
    this.dome.renderOrder = -10;
    scene.add(this.sun, this.sun.target, this.sky, this.dome);
    this.wear("light");
  }

  wear(theme: "light" | "dark"): void {
    const look = LOOKS[theme];
    this.sun.color.set(look.warmth);
    this.sun.intensity = look.sun;
    this.sky.color.set(look.zenith).lerp(new Color("white"), 0.45);
    this.sky.groundColor.set(look.ground).multiplyScalar(0.72);
    this.sky.intensity = look.sky;
    this.dome.material.uniforms.uZenith!.value.set(look.zenith);
    this.dome.material.uniforms.uHorizon!.value.set(look.horizon);
  }

  /** Light all of this box, with its shadow's pixels spent on nothing else. */
  light(box: Box3): void {
    const ball = box.getBoundingSphere(new Sphere());
    const radius = Math.max(ball.radius, 0.5);
    const eye = this.sun.shadow.camera;
    this.sun.position.copy(ball.center).addScaledVector(SUN, 3 * radius);
    this.sun.target.position.copy(ball.center);
    this.sun.target.updateMatrixWorld();
    [eye.left, eye.right, eye.bottom, eye.top, eye.near, eye.far] = [-radius, radius, -radius, radius, radius, 5.5 * radius];
    eye.updateProjectionMatrix();
    const texel = (2 * radius) / this.sun.shadow.mapSize.x;
    this.sun.shadow.bias = -0.0006;
    this.sun.shadow.normalBias = 1.3 * texel;
  }

  /** Hide the sky, for pictures without background. */
  set visible(is: boolean) {
    this.dome.visible = is;
  }
}

function domeMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    side: BackSide, depthTest: false, depthWrite: false, toneMapped: false,
    uniforms: { uZenith: { value: new Color() }, uHorizon: { value: new Color() } },
    vertexShader: `varying vec3 vWay; void main() {
      vWay = position; vec4 at = projectionMatrix * mat4(mat3(modelViewMatrix)) * vec4(position, 1.0);
      vWay = position; gl_Position = at.xyww;
      if (isOrthographic) { gl_Position = vec4(position.xy * 4.0, 0.5, 1.0); vWay = vec3(1.0, 0.05 + 0.05 * position.y * 4.0, 0.0); } }`,
    fragmentShader: `uniform vec3 uZenith; uniform vec3 uHorizon; varying vec3 vWay; void main() {
      float up = max(normalize(vWay).y, 0.0); gl_FragColor = vec4(mix(uHorizon, uZenith, 1.0 - pow(1.0 - up, 5.0)), 1.0);
      #include <colorspace_fragment>
      ${DITHER}
    }`,
  });
}
