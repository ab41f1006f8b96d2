// What draws the scene, and when? Only when something changed. While it moves and the machine is slow, with fewer pixels; sharp again as soon as it rests.

import { NeutralToneMapping, PCFShadowMap, Scene, SRGBColorSpace, WebGLRenderer, type Camera } from "three";
import { Pace } from "./pace";

const REST = 160; // milliseconds after the last motion until the sharp picture
const REST_SLOW = 420; // where that picture takes a while

export class Stage {
  readonly scene = new Scene();
  readonly canvas: HTMLCanvasElement;
  readonly renderer: WebGLRenderer;
  readonly pace: Pace;
  camera: (wide: number, high: number) => Camera = () => { throw new Error("no camera"); };
  beforeDraw: Array<(now: number) => boolean> = []; // moves what moves; true: it goes on
  afterDraw: Array<() => void> = []; // what is laid over the view follows
  whileMoving: (moving: boolean) => void = () => {}; // what is to be simpler then
  wide = 1;
  high = 1;
  private asked = 0;
  private inMotion = false; // asked for by something that moves
  private sharpener = 0;

  constructor(private readonly root: HTMLElement) {
    this.pace = new Pace(isSoftware());
    this.renderer = new WebGLRenderer({ antialias: !this.pace.software, alpha: false, powerPreference: "high-performance" });
    this.canvas = this.renderer.domElement;
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false; // shadows move only when the tree does
    root.prepend(this.canvas);
    new ResizeObserver(() => this.resized()).observe(root);
    this.resized();
  }

  /** Draw soon. `moving`: more will follow, so quick is better than sharp. */
  draw(moving = false): void {
    this.inMotion ||= moving;
    this.asked ||= requestAnimationFrame((now) => this.frame(now));
  }

  /** The tree changed: its shadow too. */
  shadows(): void {
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
  }

  /** Draw at once and return; for pictures. */
  drawNow(camera = this.camera(this.wide, this.high)): void {
    this.renderer.render(this.scene, camera);
  }

  private resized(): void {
    this.wide = Math.max(1, this.root.clientWidth);
    this.high = Math.max(1, this.root.clientHeight);
    this.renderer.setSize(this.wide, this.high);
    this.draw();
  }

  private frame(now: number): void {
    this.asked = 0;
    const goesOn = this.beforeDraw.map((move) => move(now)).some(Boolean);
    const moving = this.inMotion || goesOn;
    this.inMotion = goesOn;
    const ratio = this.pace.ratio(moving, devicePixelRatio);
    if (Math.abs(ratio - this.renderer.getPixelRatio()) > 0.01) this.renderer.setPixelRatio(ratio);
    this.whileMoving(moving);
    this.drawNow();
    this.afterDraw.forEach((follow) => follow());
    this.pace.drew(performance.now(), moving);
    clearTimeout(this.sharpener);
    if (goesOn) this.draw(true);
    else if (moving) this.sharpener = window.setTimeout(() => this.draw(), this.pace.software ? REST_SLOW : REST);
  }
}

/** Is there no graphics card? Asked of a context of its own, for the answer decides how the real one is made. */
function isSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const about = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl ? String(gl.getParameter(about ? about.UNMASKED_RENDERER_WEBGL : gl.RENDERER)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
