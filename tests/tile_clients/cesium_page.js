// CesiumJS in a page, driven as the page of 3d-tiles-renderer is. The world is placed on the globe, which is not drawn.
/* global Cesium */
const widget = new Cesium.CesiumWidget(document.body.appendChild(document.createElement('div')), {
  globe: false, baseLayer: false, skyBox: false, skyAtmosphere: false, useDefaultRenderLoop: false, creditContainer: document.createElement('div'),
});
widget.container.style.cssText = 'width: 100vw; height: 100vh';
widget.resize();
const { camera, scene } = widget;
const frame = Cesium.Transforms.eastNorthUpToFixedFrame(Cesium.Cartesian3.fromDegrees(8.5, 47.4, 0));
const aspect = innerWidth / innerHeight;
camera.frustum.fov = 2 * Math.atan(Math.tan(Math.PI / 6) * aspect); // of the longer side: 60 degrees from top to bottom
let tileset = null;
const faults = [];

const point = (x, y, z) => Cesium.Matrix4.multiplyByPoint(frame, new Cesium.Cartesian3(x, y, z), new Cesium.Cartesian3());
const vector = (x, y, z) => Cesium.Matrix4.multiplyByPointAsVector(frame, new Cesium.Cartesian3(x, y, z), new Cesium.Cartesian3());

window.client = {
  async open({ url, lines }) {
    if (tileset) scene.primitives.remove(tileset);
    faults.length = 0;
    tileset = await Cesium.Cesium3DTileset.fromUrl(url, { maximumScreenSpaceError: 16 * innerHeight / lines });
    tileset.modelMatrix = frame;
    const own = tileset;
    own.tileFailed.addEventListener(({ url: failed, message }) => { if (own === tileset) faults.push(`${failed}: ${message}`); });
    scene.primitives.add(tileset);
  },
  async view({ east, north, up, heading, pitch }) {
    const h = heading * Math.PI / 180, p = pitch * Math.PI / 180;
    camera.setView({
      destination: point(east, north, up),
      orientation: {
        direction: vector(Math.sin(h) * Math.cos(p), Math.cos(h) * Math.cos(p), Math.sin(p)),
        up: vector(-Math.sin(h) * Math.sin(p), -Math.cos(h) * Math.sin(p), Math.cos(p)),
      },
    });
    const end = performance.now() + 60_000;
    for (let calm = 0; calm < 10;) {
      if (performance.now() > end) { faults.push(`not all tiles came within 60 s: ${tileset.statistics.numberOfPendingRequests} requests, ${tileset.statistics.numberOfTilesProcessing} in work`); break; }
      await new Promise((resolve) => setTimeout(resolve, 8));
      widget.render();
      calm = tileset.tilesLoaded && tileset.statistics.selected > 0 ? calm + 1 : 0;
    }
    const { selected, numberOfTrianglesSelected: triangles } = tileset.statistics;
    return { tiles: selected, triangles, faults: [...faults] };
  },
};
