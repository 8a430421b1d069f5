// The page of a lit model: it is shown as it is, colours and textures without a light, from the
// camera that it brings, to be turned around or to be walked in.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {GLTFLoader} from 'three/examples/jsm/loaders/GLTFLoader.js';
import {Walk} from './Walk.js';

const HELP = {
  orbit: 'Drag to turn, right drag to shift, wheel to come nearer. Keys: W walks, R resets, H hides this panel.',
  walk: 'Drag to look. Arrows or W A S D to go, E and Q up and down, Shift to run. Keys: O orbits, R resets, H hides this panel.',
};
/// The nearest and the farthest that is seen, parts of the scene's diagonal.
const NEAR = 1e-4, FAR = 10;

const element = (id) => document.getElementById(id);
const scene = JSON.parse(element('scene').textContent);
const vector = (numbers) => new THREE.Vector3(...numbers);

/// The bytes that the page carries.
function modelBytes() {
  const text = atob(element('model').textContent.trim());
  return Uint8Array.from(text, (character) => character.charCodeAt(0)).buffer;
}

/// Metres as a person reads them.
function length(metres) {
  const [unit, factor] = metres >= 1 ? ['m', 1] : metres >= 0.01 ? ['cm', 100] : ['mm', 1000];
  return `${Number((metres * factor).toPrecision(3))} ${unit}`;
}

class Page {
  constructor(gltf) {
    // The model on black: where there is nothing, there is no light.
    this.world = new THREE.Scene();
    this.world.add(gltf.scene);
    this.box = new THREE.Box3().setFromObject(gltf.scene);
    this.diagonal = this.box.isEmpty() ? 1 : this.box.getSize(new THREE.Vector3()).length();
    // Between the ends of the range 24 bits of depth would mix what lies a millimetre apart.
    this.renderer = new THREE.WebGLRenderer({canvas: element('view'), antialias: true, logarithmicDepthBuffer: true});
    for (const mesh of gltf.scene.getObjectsByProperty('isMesh', true)) {
      if (mesh.material.map) mesh.material.map.anisotropy = this.renderer.capabilities.getMaxAnisotropy();
    }

    // The eye, and two ways to move it.
    const lens = gltf.cameras[0];
    this.camera = new THREE.PerspectiveCamera(lens.fov, 1, NEAR * this.diagonal, FAR * this.diagonal);
    this.camera.up.copy(vector(scene.up));
    this.orbit = new OrbitControls(this.camera, this.renderer.domElement);
    this.orbit.addEventListener('change', () => this.draw());
    this.walk = new Walk(this.camera, this.renderer.domElement, this.diagonal, () => this.draw());
    this.reset();
    this.listen();
    this.move('orbit');
    this.resize();
  }

  reset() {
    this.camera.position.copy(vector(scene.eye));
    this.camera.lookAt(vector(scene.focalPoint));
    this.orbit.target.copy(vector(scene.focalPoint));
    this.orbit.update();
    this.draw();
  }

  /// Moves the eye by `way` from now on: orbit or walk.
  move(way) {
    if (way === 'orbit') {
      // About what lies before the eye.
      const distance = this.camera.position.distanceTo(this.orbit.target);
      const forward = this.camera.getWorldDirection(new THREE.Vector3());
      this.orbit.target.copy(this.camera.position).addScaledVector(forward, distance);
    }
    this.orbit.enabled = way === 'orbit';
    this.walk.enabled = way === 'walk';
    element('orbit').setAttribute('aria-pressed', way === 'orbit');
    element('walk').setAttribute('aria-pressed', way === 'walk');
    element('help').textContent = HELP[way];
    this.renderer.domElement.focus();
  }

  listen() {
    window.addEventListener('resize', () => this.resize());
    window.addEventListener('hashchange', () => this.showPanel());
    element('orbit').addEventListener('click', () => this.move('orbit'));
    element('walk').addEventListener('click', () => this.move('walk'));
    element('reset').addEventListener('click', () => this.reset());
    window.addEventListener('keydown', (event) => {
      if (event.code === 'KeyO') this.move('orbit');
      if (event.code === 'KeyW' && !this.walk.enabled) this.move('walk');
      if (event.code === 'KeyR') this.reset();
      if (event.code === 'KeyH') document.body.classList.toggle('bare');
    });
    const size = this.box.getSize(new THREE.Vector3());
    element('size').textContent = this.box.isEmpty() ? 'no light' : size.toArray().map(length).join(' × ');
    this.showPanel();
  }

  /// `#bare` at the end of the address leaves the model alone, as within another page.
  showPanel() { document.body.classList.toggle('bare', location.hash === '#bare'); }

  resize() {
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(window.innerWidth, window.innerHeight, false);
    this.camera.aspect = window.innerWidth / window.innerHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    this.renderer.render(this.world, this.camera);
  }
}

new GLTFLoader().parse(modelBytes(), '', (gltf) => {
  window.page = new Page(gltf);
  document.body.dataset.state = 'drawn';
}, (error) => {
  element('help').textContent = `The model of this page cannot be shown: ${error.message || error}.`;
  document.body.dataset.state = 'failed';
});
