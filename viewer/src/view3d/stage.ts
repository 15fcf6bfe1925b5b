import { DirectionalLight, HemisphereLight, PCFShadowMap, Scene, Vector3, WebGLRenderer } from "three";
import type { CameraRig } from "./camera";
import { OVER, SOLID } from "./layers";
import type { Palette } from "./palette";

/** Largest number of picture pixels per page pixel: more cost time and are hardly visible. */
const FINEST = 2;
const SHADOW_PIXELS = 1024;
/** Direction from the figure to the light. */
const LIGHT = new Vector3(1.5, 4.2, 2.4);

/** Renderer and lights; redraws the picture when needed. */
export class Stage {
  readonly scene = new Scene();
  readonly renderer: WebGLRenderer;
  private readonly sky = new HemisphereLight(0xffffff, 0x8a8f96, 1.9);
  private readonly sun = new DirectionalLight(0xffffff, 2.1);
  private asked = 0;

  /** Throws if the browser has no WebGL. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    height: number,
    private readonly prepare: () => CameraRig,
  ) {
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: true,
      stencil: true,
      preserveDrawingBuffer: true,
    });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, FINEST));
    this.renderer.autoClear = false;
    this.renderer.debug.checkShaderErrors = false;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.light(height);
  }

  recolor(colors: Palette): void {
    // The background is opaque: some browsers show black behind a transparent canvas with a sticky position.
    this.renderer.setClearColor(colors.paper, 1);
    this.renderer.setClearColor(colors.paper);
    this.sky.groundColor.set(colors.dark ? 0x2a2f36 : 0xb4bac2);
    this.sky.intensity = colors.dark ? 1.5 : 2.0;
    this.sun.intensity = colors.dark ? 2.0 : 1.9;
  }

  /** Moves the light with a position. */
  follow(place: Vector3): void {
    this.sun.target.position.copy(place);
    this.sun.position.copy(place).add(LIGHT);
  }

  resize(width: number, height: number): void {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, FINEST));
    this.renderer.setSize(width, height, false);
  }

  /** Requests a picture at the next animation frame. */
  invalidate(): void {
    if (this.asked === 0) {
      this.asked = requestAnimationFrame(() => this.draw());
    }
  }

  /** Draws now: first the figure, then the arrows over it. */
  draw(): void {
    const { camera } = this.prepare();
    cancelAnimationFrame(this.asked);
    this.asked = 0;
    this.renderer.clear();
    this.renderer.shadowMap.needsUpdate = true;
    camera.layers.set(SOLID);
    this.renderer.render(this.scene, camera);
    this.renderer.clearDepth();
    camera.layers.set(OVER);
    this.renderer.render(this.scene, camera);
  }

  dispose(): void {
    cancelAnimationFrame(this.asked);
    this.renderer.dispose();
  }

  private light(height: number): void {
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
    this.sun.shadow.radius = 5;
    this.sun.shadow.bias = -0.0006;
    this.sun.shadow.normalBias = 0.02;
    const reach = Math.max(1.2, 0.85 * height);
    Object.assign(this.sun.shadow.camera, {
      left: -reach,
      right: reach,
      top: reach,
      bottom: -reach,
      near: 0.5,
      far: 12,
    });
    for (const lamp of [this.sky, this.sun]) {
      lamp.layers.enable(OVER);
      this.scene.add(lamp);
    }
    this.scene.add(this.sun.target);
  }
}
