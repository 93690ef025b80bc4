// 3d-tiles-renderer in a page. The test drives `client`: opens a tileset, moves the camera, waits until all tiles of the view are there.
import { DirectionalLight, HemisphereLight, MathUtils, PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { TilesRenderer } from '3d-tiles-renderer';
import { ImplicitTilingPlugin } from '3d-tiles-renderer/plugins';
import { TilesetValidationPlugin } from '3d-tiles-renderer/src/three/plugins/TilesetValidationPlugin.js';

const renderer = new WebGLRenderer({ antialias: false });
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);
const scene = new Scene(), camera = new PerspectiveCamera(60, innerWidth / innerHeight, 1, 2_000_000);
scene.add(new DirectionalLight('white', 2), new HemisphereLight('white', 'grey', 2));
let tiles = null;
const faults = [];

window.client = {
  open({ url, lines, check_boxes }) {
    if (tiles) { scene.remove(tiles.group); tiles.dispose(); }
    faults.length = 0;
    tiles = new TilesRenderer(url);
    if (url.endsWith('implicit.json')) tiles.registerPlugin(new ImplicitTilingPlugin());
    if (check_boxes) tiles.registerPlugin(new TilesetValidationPlugin());
    tiles.setCamera(camera);
    tiles.setResolution(camera, Math.round(lines * camera.aspect), lines); // as if the window had this number of lines
    tiles.group.rotation.x = -Math.PI / 2;
    tiles.addEventListener('load-error', ({ error, url: failed }) => faults.push(`${failed}: ${error.message}`));
    scene.add(tiles.group);
  },
  async view({ east, north, up, heading, pitch }) {
    camera.position.set(east, up, -north);
    camera.rotation.set(MathUtils.degToRad(pitch), MathUtils.degToRad(-heading), 0, 'YXZ');
    camera.updateMatrixWorld();
    scene.updateMatrixWorld(); // the tiles are turned, also before the first picture
    const end = performance.now() + 60_000;
    for (let calm = 0; calm < 20;) {
      if (performance.now() > end) { faults.push('not all tiles came within 60 s'); break; }
      await new Promise((resolve) => setTimeout(resolve, 8));
      tiles.update();
      calm = tiles.root && tiles.loadProgress === 1 && tiles.visibleTiles.size > 0 ? calm + 1 : 0;
    }
    renderer.render(scene, camera);
    let triangles = 0;
    for (const tile of tiles.visibleTiles) tile.engineData.scene?.traverse(({ geometry, count = 1 }) => {
      if (geometry) triangles += (geometry.index ? geometry.index.count : geometry.attributes.position.count) / 3 * count;
    });
    return { tiles: tiles.visibleTiles.size, triangles, faults: [...faults] };
  },
};
