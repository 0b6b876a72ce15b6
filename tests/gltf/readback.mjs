// Reads glTF files back with three.js and holds the posed surface against OBJ files of the same moments.
//
//   node readback.mjs cases.json
//
// cases.json: [{"file": "a.glb", "poses": [{"clip": "name", "time": 0.5, "obj": "a-0.obj", "allowed": 0.001}]}]; the time is the one in the
// glTF file, and the surfaces may be "allowed" apart.
// Prints one JSON line a pose: {"file", "clip", "time", "off", "diagonal", "reach"}, where "off" is the largest distance from a vertex of one surface to
// the nearest of the other, both ways (4 · "allowed" where it is more), and "reach" is how far three.js' surface goes in each direction of `directions`.
import fs from 'node:fs';

globalThis.self ??= globalThis;
const THREE = await import('three');
const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');

// Images need a browser, and the shape does not need images.
function withoutImages(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const length = view.getUint32(12, true);
  const root = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
  for (const list of ['images', 'textures', 'samplers']) delete root[list];
  for (const material of root.materials ?? []) {
    delete material.pbrMetallicRoughness?.baseColorTexture;
    delete material.emissiveTexture;
  }
  let text = new TextEncoder().encode(JSON.stringify(root));
  const padded = Math.ceil(text.length / 4) * 4;
  const rest = bytes.subarray(20 + length);
  const out = new Uint8Array(20 + padded + rest.length).fill(0x20, 20, 20 + padded);
  out.set(bytes.subarray(0, 12));
  out.set(text, 20);
  out.set(rest, 20 + padded);
  const header = new DataView(out.buffer);
  header.setUint32(8, out.length, true);
  header.setUint32(12, padded, true);
  header.setUint32(16, 0x4e4f534a, true);
  return out.buffer;
}

function posed(scene) {
  const points = [];
  scene.updateMatrixWorld(true);
  scene.traverse((thing) => {
    if (!thing.isMesh) return;
    thing.skeleton?.update();
    const used = thing.geometry.index ? new Set(thing.geometry.index.array) : null;
    const position = thing.geometry.attributes.position;
    const point = new THREE.Vector3();
    const sets = [];
    for (let set = 0; thing.isSkinnedMesh && set < 8; set++) {
      const at = (name) => thing.geometry.attributes[set ? `${name}s_${set}` : `skin${name === 'joint' ? 'Index' : 'Weight'}`];
      if (at('joint')) sets.push([at('joint'), at('weight')]);
    }
    for (let v = 0; v < position.count; v++) {
      if (used && !used.has(v)) continue;
      if (sets.length < 2) {
        thing.getVertexPosition(v, point);
        // A skinned vertex comes in the mesh's own space as well.
        point.applyMatrix4(thing.matrixWorld);
      } else {
        // three.js itself stops at four joints a vertex, and has scaled their weights up to 1 on reading.
        let others = 0;
        for (const [, weights] of sets.slice(1)) for (let i = 0; i < 4; i++) others += weights.getComponent(v, i);
        THREE.Mesh.prototype.getVertexPosition.call(thing, v, point);
        const sum = new THREE.Vector3();
        for (const [set, [joints, weights]] of sets.entries()) for (let i = 0; i < 4; i++) {
          const share = set === 0 ? 1 - others : 1;
          const joint = joints.getComponent(v, i);
          const moved = point.clone().applyMatrix4(thing.skeleton.boneInverses[joint]).applyMatrix4(thing.skeleton.bones[joint].matrixWorld);
          sum.addScaledVector(moved, weights.getComponent(v, i) * share);
        }
        point.copy(sum);
      }
      points.push([point.x, point.y, point.z]);
    }
  });
  return points;
}

function objPoints(file) {
  return fs.readFileSync(file, 'utf8').split('\n').filter((line) => line.startsWith('v ')).map((line) => line.slice(2).split(' ').map(Number));
}

// Along the axes, the diagonals of their planes, and those of space, each both ways.
const directions = [];
for (let x = -1; x <= 1; x++) for (let y = -1; y <= 1; y++) for (let z = -1; z <= 1; z++) {
  const length = Math.hypot(x, y, z);
  if (length > 0) directions.push([x / length, y / length, z / length]);
}

function reach(points) {
  return directions.map(([x, y, z]) => points.reduce((far, p) => Math.max(far, p[0] * x + p[1] * y + p[2] * z), -Infinity));
}

// Largest distance from a point of `from` to the nearest of `to`, by a grid of cells.
function oneWay(from, to, cell) {
  const cells = new Map();
  const key = (p) => p.map((x) => Math.floor(x / cell));
  for (const p of to) {
    const k = key(p).join();
    if (!cells.has(k)) cells.set(k, []);
    cells.get(k).push(p);
  }
  let worst = 0;
  for (const p of from) {
    const [x, y, z] = key(p);
    let best = Infinity;
    for (let dx = -1; dx <= 1; dx++) for (let dy = -1; dy <= 1; dy++) for (let dz = -1; dz <= 1; dz++) {
      for (const q of cells.get(`${x + dx},${y + dy},${z + dz}`) ?? []) best = Math.min(best, Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
    // Nothing within a cell: farther than the cell is wide.
    worst = Math.max(worst, best === Infinity ? cell : best);
  }
  return worst;
}

const cases = JSON.parse(fs.readFileSync(process.argv[2], 'utf8'));
for (const { file, poses } of cases) {
  const gltf = await new Promise((done, failed) => new GLTFLoader().parse(withoutImages(fs.readFileSync(file)), '', done, failed));
  const mixer = new THREE.AnimationMixer(gltf.scene);
  for (const { clip, time, obj, allowed } of poses) {
    mixer.stopAllAction();
    const found = gltf.animations.find((animation) => animation.name === clip);
    if (found) {
      const action = mixer.clipAction(found);
      // Looping would wrap the last moment to the first.
      action.setLoop(THREE.LoopOnce).clampWhenFinished = true;
      action.play();
      mixer.setTime(time);
    }
    const [ours, theirs] = [objPoints(obj), posed(gltf.scene)];
    let [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (const p of ours) for (let i = 0; i < 3; i++) { low[i] = Math.min(low[i], p[i]); high[i] = Math.max(high[i], p[i]); }
    const diagonal = Math.hypot(...high.map((h, i) => h - low[i]));
    // Wide enough to tell whether the surfaces are as close as they may be, and no wider: a cell of a fine surface holds many vertices.
    const cell = Math.max(4 * allowed, 1e-9);
    const off = ours.length && theirs.length ? Math.max(oneWay(ours, theirs, cell), oneWay(theirs, ours, cell)) : ours.length === theirs.length ? 0 : Infinity;
    console.log(JSON.stringify({ file, clip, time, off, diagonal, reach: reach(theirs) }));
  }
}
