// Walking through a scene: the mouse turns the head, keys move the feet. Up stays up.
import {MathUtils, Vector3} from 'three';

const SPEED = 1.4;        ///< m/s, of a person who walks
const LONGEST = 15;       ///< seconds from one end of a small scene to the other
const RUNNING = 3;        ///< times as fast
const TURN = 0.004;       ///< radians a pixel
const STEEPEST = 1.5;     ///< radians above or below the horizon
const LONGEST_STEP = 0.1;  ///< seconds; a picture that takes longer makes no leap

/// Forwards, to the right, upwards.
const STEPS = {
  KeyW: [1, 0, 0], ArrowUp: [1, 0, 0], KeyS: [-1, 0, 0], ArrowDown: [-1, 0, 0],
  KeyD: [0, 1, 0], ArrowRight: [0, 1, 0], KeyA: [0, -1, 0], ArrowLeft: [0, -1, 0],
  KeyE: [0, 0, 1], PageUp: [0, 0, 1], KeyQ: [0, 0, -1], PageDown: [0, 0, -1],
};

export class Walk {
  /// `diagonal` of the scene, m; `changed` is called when the camera has moved.
  constructor(camera, surface, diagonal, changed) {
    this.camera = camera;
    this.changed = changed;
    this.speed = Math.min(SPEED, diagonal / LONGEST);
    this.enabled = false;
    this.held = new Set();
    surface.addEventListener('pointerdown', (event) => surface.setPointerCapture(event.pointerId));
    surface.addEventListener('pointermove', (event) => {
      if (this.enabled && event.buttons) this.look(event.movementX, event.movementY);
    });
    window.addEventListener('keydown', (event) => this.press(event));
    window.addEventListener('keyup', (event) => this.held.delete(event.code));
    window.addEventListener('blur', () => this.held.clear());
  }

  /// Turns about the vertical and about the line to the right, in pixels of the mouse.
  look(x, y) {
    const {up} = this.camera;
    const forward = this.camera.getWorldDirection(new Vector3());
    const height = Math.asin(MathUtils.clamp(forward.dot(up), -1, 1));
    const wanted = MathUtils.clamp(height - TURN * y, -STEEPEST, STEEPEST);
    const right = forward.clone().cross(up).normalize();
    forward.applyAxisAngle(right, wanted - height).applyAxisAngle(up, -TURN * x);
    this.camera.lookAt(this.camera.position.clone().add(forward));
    this.changed();
  }

  press(event) {
    if (!this.enabled || !STEPS[event.code] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    this.runs = event.shiftKey;
    const stands = this.held.size === 0;
    this.held.add(event.code);
    if (stands) requestAnimationFrame((time) => this.step(time, time));
  }

  /// As far as keys are held, from picture to picture.
  step(last, now) {
    if (!this.enabled || this.held.size === 0) return;
    const seconds = Math.min(LONGEST_STEP, (now - last) / 1000);
    this.go(seconds * this.speed * (this.runs ? RUNNING : 1));
    requestAnimationFrame((time) => this.step(now, time));
  }

  /// Moves by `metres` along what the held keys say; forwards is level.
  go(metres) {
    const {up} = this.camera;
    const forward = this.camera.getWorldDirection(new Vector3()).projectOnPlane(up).normalize();
    const right = forward.clone().cross(up);
    const way = new Vector3();
    for (const code of this.held) {
      const [along, across, upwards] = STEPS[code];
      way.addScaledVector(forward, along).addScaledVector(right, across).addScaledVector(up, upwards);
    }
    this.camera.position.addScaledVector(way.normalize(), metres);
    this.changed();
  }
}
