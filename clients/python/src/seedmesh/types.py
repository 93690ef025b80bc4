"""Generated from api_schema by clients/generate_types.py. Do not edit."""
from typing import Any, Dict, List, Literal, TypedDict, Union


class Output(TypedDict, total=False):
    format: Literal['glb', 'gltf', 'zip', 'png16', 'png8', 'rgb24', 'rgba32', 'r16', 'ply', 'placements', 'geojson']
    profile: Literal['core', 'web', 'tiles', 'unity', 'unreal', 'godot', 'blender']
    name: str
    provenance: Literal['full', 'none']
    animation: Literal['none', 'growth']
    textures: Union[int, Literal['none', 'links']]
    image_format: Literal['auto', 'png', 'webp', 'both']
    lods: Union[int, List[float]]
    impostor: bool
    wind: Literal['none', 'weights']
    collision: Literal['none', 'plain', 'unreal', 'godot']
    instancing: Literal['auto', 'nodes', 'gpu', 'merge']
    variants: int
    max_triangles: int
    tangents: Literal['auto', 'none']


class _ProblemErrorsItemRequired(TypedDict):
    pointer: str
    code: Literal['syntax', 'duplicate_key', 'unknown_key', 'unknown_name', 'missing', 'wrong_type', 'out_of_range', 'invalid_value', 'conflict', 'not_available', 'evaluation', 'limit', 'truncated_list', 'deadline', 'cancelled', 'internal']
    message: str


class ProblemErrorsItem(_ProblemErrorsItemRequired, total=False):
    line: int
    column: int
    resource: Literal['modules', 'shapes', 'triangles', 'output_bytes', 'memory_bytes', 'file_bytes', 'vertices', 'points', 'segments', 'joints', 'leaves', 'iterations', 'depth', 'json_values', 'steps']
    limit: float
    needed: float
    unlisted: int


class _ProblemRequired(TypedDict):
    type: str
    title: str
    status: int


class Problem(_ProblemRequired, total=False):
    detail: str
    instance: str
    format: str
    errors: List["ProblemErrorsItem"]


class FigureSolidsItem(TypedDict, total=False):
    solid: Literal['box', 'cylinder', 'cone', 'sphere', 'pyramid', 'prism', 'triangular_prism']
    at: List[Union[float, str]]
    size: List[Union[float, str]]
    turn: List[Union[float, str]]
    material: str


class FigureMarkersItem(TypedDict):
    name: str
    points: List[List[Union[float, str]]]


class _FigureShapesItemRequired(TypedDict):
    shape: str


class FigureShapesItem(_FigureShapesItemRequired, total=False):
    values: Dict[str, Union[float, str]]
    at: List[Union[float, str]]
    turn: List[Union[float, str]]
    scale: Union[float, str]
    mirror: bool


class Figure(TypedDict, total=False):
    parameters: Dict[str, float]
    lines: List[List[List[Union[float, str]]]]
    solids: List["FigureSolidsItem"]
    markers: List["FigureMarkersItem"]
    shapes: List["FigureShapesItem"]


class _BuildingParametersShapeGrammarRulesItemOpenItemRequired(TypedDict):
    name: str


class BuildingParametersShapeGrammarRulesItemOpenItem(_BuildingParametersShapeGrammarRulesItemOpenItemRequired, total=False):
    low: float
    high: float


class _BuildingParametersShapeGrammarRulesItemRequired(TypedDict):
    pair: List["Figure"]


class BuildingParametersShapeGrammarRulesItem(_BuildingParametersShapeGrammarRulesItemRequired, total=False):
    name: str
    weight: float
    open: List["BuildingParametersShapeGrammarRulesItemOpenItem"]
    condition: str


class _BuildingParametersShapeGrammarRequired(TypedDict):
    rules: List["BuildingParametersShapeGrammarRulesItem"]
    initial: List["Figure"]


class BuildingParametersShapeGrammar(_BuildingParametersShapeGrammarRequired, total=False):
    dimensions: int
    shapes: Dict[str, "Figure"]
    mirror: bool
    width: float
    height: float
    material: str
    marker_size: float


class _BuildingParametersEditsItemRequired(TypedDict):
    shape: str


class BuildingParametersEditsItem(_BuildingParametersEditsItemRequired, total=False):
    attributes: Dict[str, Union[float, str, bool]]
    rule: str
    remove: bool


class BuildingParametersDerivation(TypedDict, total=False):
    order: Literal['breadth', 'depth']
    mode: Literal['parallel', 'sequential']


class _EmissionRequired(TypedDict):
    color: str


class Emission(_EmissionRequired, total=False):
    strength: float


class _SpecularRequired(TypedDict):
    color: str


class Specular(_SpecularRequired, total=False):
    strength: float


class Images(TypedDict, total=False):
    color: str
    normal: str
    surface: str
    cut_out: bool


class BuildingParametersMaterialsValue(TypedDict, total=False):
    color: str
    roughness: float
    metallic: float
    opacity: float
    emission: "Emission"
    specular: "Specular"
    tile: List[float]
    images: "Images"
    texture: Literal['auto', 'none', 'brick', 'plaster', 'roof_tile', 'slate', 'planks', 'ashlar', 'concrete', 'sheet', 'panels', 'dressed_stone', 'paint', 'brick_bay', 'plaster_bay', 'planks_bay', 'ashlar_bay']
    texture_seed: int


class BuildingParametersAssetsValue(TypedDict, total=False):
    model: "Child"
    glb: str


class BuildingParameters(TypedDict, total=False):
    rules: Union[str, Dict[str, str]]
    tables: Dict[str, str]
    blueprint: Literal['church', 'factory', 'house', 'office_tower', 'parisian_block', 'skyscraper', 'temple', 'terraced_house', 'villa', 'warehouse']
    shape_grammar: "BuildingParametersShapeGrammar"
    start: str
    size: List[float]
    footprint: List[List[List[float]]]
    attributes: Dict[str, Union[float, str, bool]]
    edits: List["BuildingParametersEditsItem"]
    iterations: int
    derivation: "BuildingParametersDerivation"
    repeat: Literal['nearest', 'ceil']
    weights: Literal['normalize', 'strict']
    restrict: Literal['none', 'non_erasing', 'unimarker', 'split']
    materials: Dict[str, "BuildingParametersMaterialsValue"]
    facade_image: str
    facade_tile: List[float]
    textures: Literal['auto', 'made', 'none']
    assets: Dict[str, "BuildingParametersAssetsValue"]


class CityParametersArea(TypedDict, total=False):
    size: List[float]
    polygon: List[List[List[float]]]


class CityParametersMapsZonesItem(TypedDict):
    zone: str
    area: Union[str, Dict[str, Any]]


class CityParametersMaps(TypedDict, total=False):
    density: Union[str, Dict[str, Any]]
    water: Union[str, Dict[str, Any]]
    obstacles: Union[str, Dict[str, Any]]
    pattern: Union[str, Dict[str, Any]]
    zones: List["CityParametersMapsZonesItem"]
    height: Union[str, Dict[str, Any]]
    height_range: List[float]


class CityParametersGiven(TypedDict, total=False):
    streets: Dict[str, Any]
    water: Dict[str, Any]
    footprints: Dict[str, Any]


class CityParametersStreetsClassesHighway(TypedDict, total=False):
    width: float
    lanes: int
    sidewalk: float
    grade: float
    trees: float


class CityParametersStreetsClassesMajor(TypedDict, total=False):
    width: float
    lanes: int
    sidewalk: float
    grade: float
    trees: float


class CityParametersStreetsClassesMinor(TypedDict, total=False):
    width: float
    lanes: int
    sidewalk: float
    grade: float
    trees: float


class CityParametersStreetsClassesLane(TypedDict, total=False):
    width: float
    lanes: int
    sidewalk: float
    grade: float
    trees: float


class CityParametersStreetsClasses(TypedDict, total=False):
    highway: "CityParametersStreetsClassesHighway"
    major: "CityParametersStreetsClassesMajor"
    minor: "CityParametersStreetsClassesMinor"
    lane: "CityParametersStreetsClassesLane"


class CityParametersStreetsTensorFieldsItem(TypedDict, total=False):
    type: Literal['grid', 'radial', 'boundary', 'polyline', 'height']
    position: List[float]
    angle: float
    size: float
    weight: float
    points: List[List[float]]


class CityParametersStreetsTensor(TypedDict, total=False):
    fields: List["CityParametersStreetsTensorFieldsItem"]
    t_junctions: float


class CityParametersStreetsWards(TypedDict, total=False):
    count: int
    size: float
    gates: int
    citadel: bool
    wall_height: float


class CityParametersStreets(TypedDict, total=False):
    method: Literal['growth', 'tensor', 'wards', 'given']
    productions: List[str]
    pattern: Literal['organic', 'raster', 'radial', 'slope']
    second_pattern: Literal['organic', 'raster', 'radial', 'slope']
    minor_pattern: Literal['organic', 'raster', 'radial', 'slope']
    angle: float
    centre: List[float]
    major_spacing: float
    highway_spacing: float
    block: List[float]
    fill: float
    length: float
    length_spread: float
    branch_probability: float
    bend: float
    noise: float
    jitter: float
    snap: float
    clearance: float
    minimal_angle: float
    dead_ends: float
    crossings: float
    lane_share: float
    roundabouts: float
    roundabout_radius: float
    classes: "CityParametersStreetsClasses"
    bridge_length: float
    tunnel_length: float
    tensor: "CityParametersStreetsTensor"
    wards: "CityParametersStreetsWards"


class CityParametersLots(TypedDict, total=False):
    method: Literal['recursive', 'offset', 'skeleton', 'burgage', 'none']
    area: List[float]
    width: float
    offset_width: float
    irregularity: float
    corner_width: float
    corner_angle: float
    simplify: float
    park_share: float


class BuildingRule(TypedDict, total=False):
    blueprint: Literal['church', 'factory', 'house', 'office_tower', 'parisian_block', 'skyscraper', 'temple', 'terraced_house', 'villa', 'warehouse']
    building: "Child"
    attributes: Dict[str, Union[float, str, bool]]
    floors_as: str
    weight: float
    density: List[float]
    distance: List[float]
    lot: List[float]
    frontage: List[float]
    streets: List[Literal['highway', 'major', 'minor', 'lane']]
    floors: List[int]
    front: float
    side: float
    shared_walls: bool
    rear: float
    width: List[float]
    depth: List[float]
    share: float
    zones: List[str]


class _CityParametersBuildingsLandmarksItemRequired(TypedDict):
    model: "Child"
    position: List[float]


class CityParametersBuildingsLandmarksItem(_CityParametersBuildingsLandmarksItemRequired, total=False):
    turn: float
    plot: Literal['lot', 'block', 'square', 'free']
    radius: float


class CityParametersBuildings(TypedDict, total=False):
    rules: List["BuildingRule"]
    variants: int
    detail: int
    landmarks: List["CityParametersBuildingsLandmarksItem"]


class _CityParametersSurfacesItemRequired(TypedDict):
    name: Literal['asphalt', 'junction', 'sidewalk', 'verge', 'park', 'square', 'lot', 'water', 'marking', 'wall', 'foundation', 'bridge', 'tunnel']


class CityParametersSurfacesItem(_CityParametersSurfacesItemRequired, total=False):
    color: str
    roughness: float
    specular: "Specular"
    emission: "Emission"


class CityParametersFurnitureLamps(TypedDict, total=False):
    spacing: float
    share: float
    models: List["Child"]


class CityParametersFurnitureTrees(TypedDict, total=False):
    spacing: float
    share: float
    models: List["Child"]


class CityParametersFurnitureBenches(TypedDict, total=False):
    spacing: float
    share: float
    models: List["Child"]


class CityParametersFurnitureBins(TypedDict, total=False):
    spacing: float
    share: float
    models: List["Child"]


class CityParametersFurnitureSigns(TypedDict, total=False):
    share: float
    models: List["Child"]


class CityParametersFurnitureCars(TypedDict, total=False):
    spacing: float
    share: float
    models: List["Child"]


class CityParametersFurniture(TypedDict, total=False):
    lamps: "CityParametersFurnitureLamps"
    trees: "CityParametersFurnitureTrees"
    benches: "CityParametersFurnitureBenches"
    bins: "CityParametersFurnitureBins"
    signs: "CityParametersFurnitureSigns"
    cars: "CityParametersFurnitureCars"


class CityParametersParks(TypedDict, total=False):
    spacing: float
    models: List["Child"]


class CityParametersYards(TypedDict, total=False):
    trees: float
    models: List["Child"]
    border: Literal['none', 'hedge', 'fence', 'wall']
    front: bool
    height: float


class CityParametersChunks(TypedDict, total=False):
    by: Literal['blocks', 'squares']
    size: float


class _CityParametersCameraRequired(TypedDict):
    position: List[float]


class CityParametersCamera(_CityParametersCameraRequired, total=False):
    field_of_view: float


class CityParameters(TypedDict, total=False):
    area: "CityParametersArea"
    terrain: "Child"
    maps: "CityParametersMaps"
    given: "CityParametersGiven"
    streets: "CityParametersStreets"
    lots: "CityParametersLots"
    buildings: "CityParametersBuildings"
    surfaces: List["CityParametersSurfacesItem"]
    furniture: "CityParametersFurniture"
    parks: "CityParametersParks"
    yards: "CityParametersYards"
    chunks: "CityParametersChunks"
    camera: "CityParametersCamera"


class FractalParametersInstructions2Item(TypedDict, total=False):
    scale: Union[float, List[float]]
    rotate: List[float]
    translate: List[float]
    matrix: List[float]
    probability: float


class FractalParametersElement2(TypedDict, total=False):
    model: "Child"
    glb: str


class FractalParametersEscape(TypedDict, total=False):
    set: Literal['mandelbrot', 'julia']
    center: List[float]
    span: float
    constant: List[float]
    limit: int
    resolution: int
    relief: float
    plate: float


class FractalParameters(TypedDict, total=False):
    method: Literal['mrcm', 'frcm', 'escape']
    instructions: Union[Literal['menger_sponge', 'koch_cube', 'corner_cube', 'corner_cube_centre', 'corner_cube_outside', 'corner_cube_two_thirds', 'sierpinski_pyramid', 'sierpinski_triangle', 'word_test', 'sierpinski_tetrahedron', 'sierpinski_carpet', 'cantor_dust', 'vicsek', 'mosely_snowflake', 'jerusalem_cube', 'pascal_parity', 'dragon', 'tree', 'fern', 'koch_curve', 'koch_snowflake'], List["FractalParametersInstructions2Item"]]
    element: Union[Literal['cube', 'pyramid', 'rainbow_cube', 'sphere', 'tetrahedron', 'letter_plate', 'segment', 'plate'], "FractalParametersElement2"]
    iterations: int
    stages: List[int]
    columns: int
    text: str
    smallest: float
    surface: Literal['faces', 'merged', 'pieces']
    size: float
    color: str
    specular: "Specular"
    emission: "Emission"
    palette: List[str]
    weights: Literal['normalize', 'strict']
    points: int
    start: Literal['element', 'cube']
    drop: int
    cloud: Literal['points', 'elements', 'voxels']
    voxels: int
    escape: "FractalParametersEscape"


class _LsystemParametersTablesItemRequired(TypedDict):
    productions: List[str]


class LsystemParametersTablesItem(_LsystemParametersTablesItemRequired, total=False):
    steps: int


class _LsystemParametersAlphabetRequired(TypedDict):
    variables: str


class LsystemParametersAlphabet(_LsystemParametersAlphabetRequired, total=False):
    constants: str


class LsystemParametersAngle2(TypedDict, total=False):
    yaw: float
    pitch: float
    roll: float
    spread: float


class LsystemParametersStep2(TypedDict, total=False):
    value: float
    spread: float


class LsystemParametersWidth2(TypedDict, total=False):
    value: float
    spread: float


class _LsystemParametersTropismItemRequired(TypedDict):
    direction: List[float]


class LsystemParametersTropismItem(_LsystemParametersTropismItemRequired, total=False):
    elasticity: float
    step: float


class _LsystemParametersEnvironmentSolidsItemRequired(TypedDict):
    shape: Literal['box', 'sphere', 'cylinder', 'cone', 'mesh']


class LsystemParametersEnvironmentSolidsItem(_LsystemParametersEnvironmentSolidsItemRequired, total=False):
    role: Literal['guide', 'obstacle', 'host']
    position: List[float]
    size: List[float]
    model: "Child"
    glb: str


class LsystemParametersEnvironmentLight(TypedDict, total=False):
    cell: float
    shade: float
    falloff: float
    layers: int


class _LsystemParametersEnvironmentCompanionsItemRequired(TypedDict):
    system: "Child"


class LsystemParametersEnvironmentCompanionsItem(_LsystemParametersEnvironmentCompanionsItemRequired, total=False):
    position: List[float]


class LsystemParametersEnvironment(TypedDict, total=False):
    solids: List["LsystemParametersEnvironmentSolidsItem"]
    membership: Literal['centre', 'whole', 'clipped']
    clearance: float
    light: "LsystemParametersEnvironmentLight"
    companions: List["LsystemParametersEnvironmentCompanionsItem"]


class LsystemParametersWeather(TypedDict, total=False):
    wind: float
    direction: float
    rain: float
    snow: float
    stiffness: float


class LsystemParametersSurfacesValue(TypedDict, total=False):
    shape: Literal['simple', 'willow', 'birch', 'cordate', 'lobed', 'maple', 'ginkgo', 'compound', 'palmate', 'needles', 'pine_needles', 'palm', 'kite', 'petal', 'fruit', 'patches', 'model', 'sphere', 'disc']
    build: Literal['mesh', 'card', 'cross', 'curved', 'twig', 'bunch']
    size: float
    width: float
    fold: float
    droop: float
    pointed: float
    color: int
    picture: Literal['auto', 'own', 'none']
    model: "Child"
    glb: str
    patches: List[List[List[float]]]
    basis: Literal['bezier', 'b_spline']
    divisions: int


Texture = Literal['none', 'oak_bark', 'pine_bark', 'spruce_bark', 'willow_bark', 'birch_bark', 'beech_bark', 'cherry_bark', 'palm_bark', 'cedar_bark', 'simple_leaf', 'willow_leaf', 'birch_leaf', 'cordate_leaf', 'lobed_leaf', 'maple_leaf', 'ginkgo_leaf', 'compound_leaf', 'palmate_leaf', 'needles', 'pine_needles', 'palm_leaf', 'kite_leaf', 'petal', 'simple_twig', 'willow_twig', 'birch_twig', 'cordate_twig', 'lobed_twig', 'maple_twig', 'ginkgo_twig', 'needles_twig', 'pine_needles_twig', 'petal_twig']

class LsystemParametersMaterialsItem(TypedDict, total=False):
    name: str
    color: str
    roughness: float
    metallic: float
    opacity: float
    emission: "Emission"
    specular: "Specular"
    texture: "Texture"
    texture_seed: int
    images: "Images"


class _LsystemParametersRequired(TypedDict):
    axiom: str


class LsystemParameters(_LsystemParametersRequired, total=False):
    productions: List[str]
    iterations: int
    age: float
    timed: bool
    constants: Dict[str, Union[float, str]]
    variables: Dict[str, Union[float, str]]
    arrays: Dict[str, List[float]]
    start_each: str
    end_each: str
    rule_order: Literal['contexts_first', 'listed']
    weights: Literal['normalize', 'strict']
    strict_predecessors: bool
    ignore: str
    consider: str
    ring: bool
    decomposition: List[str]
    decomposition_depth: int
    tables: List["LsystemParametersTablesItem"]
    functions: List[str]
    modules: List[str]
    alphabet: "LsystemParametersAlphabet"
    interpretation: List[str]
    interpretation_depth: int
    angle: Union[float, "LsystemParametersAngle2"]
    step: Union[float, "LsystemParametersStep2"]
    width: Union[float, "LsystemParametersWidth2"]
    width_rule: Literal['symbols', 'decrement', 'branch_factor', 'longest_chain', 'pipe_model']
    width_decrement: float
    width_factor: float
    tip_width: float
    pipe_exponent: float
    tropism: List["LsystemParametersTropismItem"]
    environment: "LsystemParametersEnvironment"
    weather: "LsystemParametersWeather"
    surfaces: Dict[str, "LsystemParametersSurfacesValue"]
    contours: List[List[List[float]]]
    crown_normals: float
    style: Literal['tubes', 'lines']
    sides: int
    stacks: int
    taper: Literal['linear', 'none']
    share: Literal['auto', 'always', 'never']
    levels: Literal['outline', 'slices']
    adapt: bool
    weld: bool
    materials: List["LsystemParametersMaterialsItem"]


class SceneParametersGround(TypedDict, total=False):
    size: float
    outline: Literal['square', 'disc', 'none']
    color: str
    specular: "Specular"
    emission: "Emission"


class _SceneParametersPathsItemRequired(TypedDict):
    points: List[List[float]]


class SceneParametersPathsItem(_SceneParametersPathsItemRequired, total=False):
    width: float
    shown: bool
    color: str
    specular: "Specular"
    emission: "Emission"


class _SceneParametersAreasItemRequired(TypedDict):
    outline: List[List[List[float]]]


class SceneParametersAreasItem(_SceneParametersAreasItemRequired, total=False):
    name: str
    color: str
    specular: "Specular"
    emission: "Emission"
    roughness: float


class SceneParametersBuildingsItemRoof(TypedDict, total=False):
    shape: Literal['flat', 'skillion', 'gabled', 'half_hipped', 'gambrel', 'saltbox', 'round', 'hipped', 'mansard', 'pyramidal', 'dome', 'onion']
    height: float
    angle: float
    direction: float
    orientation: Literal['along', 'across']
    color: str


class _SceneParametersBuildingsItemRequired(TypedDict):
    footprint: List[List[List[float]]]


class SceneParametersBuildingsItem(_SceneParametersBuildingsItemRequired, total=False):
    name: str
    base: float
    height: float
    color: str
    material: Literal['plain', 'glass', 'metal']
    roof: "SceneParametersBuildingsItemRoof"


class _SceneParametersGeoreferenceRequired(TypedDict):
    latitude: float
    longitude: float


class SceneParametersGeoreference(_SceneParametersGeoreferenceRequired, total=False):
    projection: str


class _SceneParametersLayersItemVaryItemRequired(TypedDict):
    parameter: str


_SceneParametersLayersItemVaryItemOptional = TypedDict("_SceneParametersLayersItemVaryItemOptional", {
    'from': float,
    'to': float,
    'among': List[Union[float, str, bool]],
}, total=False)


class SceneParametersLayersItemVaryItem(_SceneParametersLayersItemVaryItemRequired, _SceneParametersLayersItemVaryItemOptional):
    pass


class _SceneParametersLayersItemPlacePositionsItemRequired(TypedDict):
    at: List[float]


class SceneParametersLayersItemPlacePositionsItem(_SceneParametersLayersItemPlacePositionsItemRequired, total=False):
    turn: float
    scale: float
    age: float
    model: "Child"


class SceneParametersLayersItemPlaceClusters(TypedDict):
    count: int
    radius: float


class SceneParametersLayersItemPlaceNoise(TypedDict, total=False):
    wavelength: float
    share: float
    soft: float


SceneParametersLayersItemPlaceSlope = TypedDict("SceneParametersLayersItemPlaceSlope", {
    'from': float,
    'to': float,
    'soft': float,
}, total=False)


SceneParametersLayersItemPlaceAltitude = TypedDict("SceneParametersLayersItemPlaceAltitude", {
    'from': float,
    'to': float,
    'soft': float,
}, total=False)


SceneParametersLayersItemPlaceAboveWater = TypedDict("SceneParametersLayersItemPlaceAboveWater", {
    'from': float,
    'to': float,
    'soft': float,
}, total=False)


SceneParametersLayersItemPlaceShade = TypedDict("SceneParametersLayersItemPlaceShade", {
    'from': float,
    'to': float,
    'soft': float,
}, total=False)


class _SceneParametersLayersItemPlaceNearItemRequired(TypedDict):
    layer: str


_SceneParametersLayersItemPlaceNearItemOptional = TypedDict("_SceneParametersLayersItemPlaceNearItemOptional", {
    'from': float,
    'to': float,
}, total=False)


class SceneParametersLayersItemPlaceNearItem(_SceneParametersLayersItemPlaceNearItemRequired, _SceneParametersLayersItemPlaceNearItemOptional):
    pass


class SceneParametersLayersItemPlace(TypedDict, total=False):
    method: Literal['poisson', 'scatter', 'clusters', 'rows', 'path', 'positions']
    positions: List["SceneParametersLayersItemPlacePositionsItem"]
    count: int
    distance: float
    spacing: List[float]
    angle: float
    stagger: float
    jitter: float
    points: List[List[float]]
    offset: float
    side: Literal['both', 'left', 'right']
    clusters: "SceneParametersLayersItemPlaceClusters"
    area: List[List[float]]
    edge: float
    density: float
    density_image: str
    noise: "SceneParametersLayersItemPlaceNoise"
    ground: List[Literal['grass', 'soil', 'rock', 'scree', 'sand', 'snow', 'litter']]
    slope: "SceneParametersLayersItemPlaceSlope"
    altitude: "SceneParametersLayersItemPlaceAltitude"
    above_water: "SceneParametersLayersItemPlaceAboveWater"
    shade: "SceneParametersLayersItemPlaceShade"
    near: List["SceneParametersLayersItemPlaceNearItem"]


class SceneParametersLayersItemFoundation(TypedDict, total=False):
    slope_width: float


class _SceneParametersLayersItemRequired(TypedDict):
    model: "Child"


class SceneParametersLayersItem(_SceneParametersLayersItemRequired, total=False):
    name: str
    variants: int
    vary: List["SceneParametersLayersItemVaryItem"]
    age: Union[float, List[float]]
    start: Union[float, List[float]]
    place: "SceneParametersLayersItemPlace"
    scale: Union[float, List[float]]
    turn: Union[float, List[float]]
    tilt: float
    upright: float
    sink: float
    crown: float
    footprint: Union[float, List[float]]
    foundation: "SceneParametersLayersItemFoundation"


class _SceneParametersCameraRequired(TypedDict):
    position: List[float]


class SceneParametersCamera(_SceneParametersCameraRequired, total=False):
    field_of_view: float
    impostors: bool


class SceneParameters(TypedDict, total=False):
    terrain: "Child"
    ground: "SceneParametersGround"
    paths: List["SceneParametersPathsItem"]
    areas: List["SceneParametersAreasItem"]
    buildings: List["SceneParametersBuildingsItem"]
    georeference: "SceneParametersGeoreference"
    layers: List["SceneParametersLayersItem"]
    age: float
    season: Literal['spring', 'summer', 'autumn', 'winter']
    competition: float
    camera: "SceneParametersCamera"
    chunks: int
    words: bool


class TerrainParametersLayersItem(TypedDict, total=False):
    name: str
    algorithm: Literal['expression', 'fault_formation', 'poisson_faulting', 'fbm', 'triangular_edge', 'diamond_square', 'square_square']
    expression: str
    combine: Literal['add', 'subtract', 'multiply', 'max', 'min', 'replace', 'none']
    mask: str
    iterations: int
    amplitude: float
    hurst: float
    noise: Literal['rolling', 'ridged', 'billow']
    wavelength: float
    fault_max: float
    fault_min: float


class TerrainParametersFracture(TypedDict, total=False):
    axes: List[float]
    depth: List[float]
    bevel: float
    strata: float
    layer: float
    tilt: float


class _TerrainParametersImageRequired(TypedDict):
    data: str


class TerrainParametersImage(_TerrainParametersImageRequired, total=False):
    encoding: Literal['grey', 'rgb24', 'rgba32', 'r16', 'r16_big', 'terrain_rgb', 'terrarium', 'metres', 's16', 's16_big', 'hgt']
    width: int
    low: float
    high: float
    flip: bool


class TerrainParametersTile(TypedDict, total=False):
    x: int
    z: int
    across: int


TerrainParametersNormalise = TypedDict("TerrainParametersNormalise", {
    'from': List[float],
    'low': float,
    'high': float,
}, total=False)


class TerrainParametersIsland(TypedDict, total=False):
    reach: float
    depth: float
    floor: float
    roughness: float


TerrainParametersTerraces = TypedDict("TerrainParametersTerraces", {
    'from': List[float],
    'count': int,
    'sharpness': float,
}, total=False)


class TerrainParametersThermal(TypedDict, total=False):
    iterations: int
    talus: float
    rate: float


class TerrainParametersHydraulic(TypedDict, total=False):
    method: Literal['droplets', 'stream_power']
    droplets: int
    lifetime: float
    inertia: float
    capacity: float
    erosion: float
    deposition: float
    evaporation: float
    radius: float
    iterations: int
    strength: float
    area_exponent: float


class TerrainParametersRefine(TypedDict, total=False):
    center: List[float]
    radius: float
    step: float
    relief: float


class _TerrainParametersOntoRequired(TypedDict):
    model: "Child"


class TerrainParametersOnto(_TerrainParametersOntoRequired, total=False):
    mapping: Literal['displacement', 'normal_map']
    subdivide: int


class TerrainParametersHeightmap(TypedDict, total=False):
    map: Literal['height', 'slope', 'curvature', 'flow', 'water', 'normal', 'color', 'splat', 'rock', 'grass', 'sand', 'snow']
    low: float
    high: float
    byte_order: Literal['little', 'big']
    flip: bool


class TerrainParameters(TypedDict, total=False):
    algorithm: Literal['fault_formation', 'poisson_faulting', 'triangular_edge', 'diamond_square', 'square_square', 'fbm', 'brownian', 'image', 'expression', 'fracture']
    expression: str
    layers: List["TerrainParametersLayersItem"]
    iterations: int
    extra_iterations: int
    resolution: int
    size: float
    shape: Literal['plane', 'sphere', 'profile']
    amplitude: float
    hurst: float
    corners: List[float]
    grid: List[float]
    edge: Literal['two_neighbours', 'avg3', 'interpolate', 'wrap']
    mode: Literal['random', 'midpoint']
    fault_max: float
    fault_min: float
    fault_step: Literal['hard', 'line', 'cosine']
    fault_width: float
    fracture: "TerrainParametersFracture"
    noise: Literal['rolling', 'ridged', 'billow']
    wavelength: float
    lacunarity: float
    warp: float
    image: "TerrainParametersImage"
    tile: "TerrainParametersTile"
    smooth: float
    normalise: "TerrainParametersNormalise"
    island: "TerrainParametersIsland"
    terraces: "TerrainParametersTerraces"
    thermal: "TerrainParametersThermal"
    hydraulic: "TerrainParametersHydraulic"
    resample: int
    mesh: Literal['grid', 'rtin', 'greedy']
    max_error: float
    skirt: float
    base: float
    refine: "TerrainParametersRefine"
    palette: Literal['alpine', 'desert', 'tropical', 'arctic', 'volcanic', 'moon', 'stone', 'mossy', 'forest', 'grey', 'none']
    specular: "Specular"
    emission: "Emission"
    water_level: float
    texture: int
    detail: bool
    onto: "TerrainParametersOnto"
    heightmap: "TerrainParametersHeightmap"


class TreeParametersRoots(TypedDict, total=False):
    count: int
    length: float
    thickness: float
    depth: float


Seed = Union[int, str]

class TreeParametersSeeds(TypedDict, total=False):
    trunk: "Seed"
    branches: "Seed"
    leaves: "Seed"


class TreeParametersLeaf(TypedDict, total=False):
    shape: Literal['simple', 'willow', 'birch', 'cordate', 'lobed', 'maple', 'ginkgo', 'compound', 'palmate', 'needles', 'pine_needles', 'palm', 'kite', 'petal']
    build: Literal['usual', 'none', 'card', 'cross', 'curved', 'mesh', 'twig', 'bunch']
    picture: Literal['auto', 'own', 'none']
    fold: float
    droop: float
    coarseness: int
    density: float
    size: float
    faces: Literal['auto', 'two_sided', 'outward']
    roll: float
    crown_normals: float
    tint: float
    hue: float
    occlusion: float
    color: str
    autumn: str
    evergreen: bool
    specular: "Specular"
    emission: "Emission"
    images: "Images"


class TreeParametersSway(TypedDict, total=False):
    wind: float
    gust: float
    time: float


class TreeParametersEzTreeLevelItem(TypedDict, total=False):
    angle: float
    children: int
    gnarliness: float
    length: float
    radius: float
    sections: int
    start: float
    taper: float
    twist: float


class TreeParametersEzTreeTrellis(TypedDict, total=False):
    enabled: bool
    x: float
    y: float
    z: float
    width: float
    height: float
    spacing: float
    strength: float
    max_distance: float
    falloff: float


class TreeParametersEzTree(TypedDict, total=False):
    scale: float
    evergreen: bool
    levels: int
    level: List["TreeParametersEzTreeLevelItem"]
    force_x: float
    force_y: float
    force_z: float
    force_strength: float
    leaf_angle: float
    leaf_count: int
    leaf_start: float
    leaf_size: float
    leaf_size_variance: float
    trellis: "TreeParametersEzTreeTrellis"


class TreeParametersSculptLevelItem(TypedDict, total=False):
    shape: Literal['box', 'sphere', 'cone', 'cylinder', 'lathe']
    width: float
    profile: List[float]
    fill: float
    fill_spread: float
    start: float
    gap: float
    gap_ratio: float
    whorl: int
    chance: float
    angle: float
    angle_tip: float
    angle_spread: float
    phase: float
    phase_spread: float
    bend: float
    bend_spread: float
    spin: float
    taper: float
    rise: float


class TreeParametersSculpt(TypedDict, total=False):
    height: float
    height_spread: float
    levels: int
    shortest: float
    trunk_radius: float
    faces: Literal['usual', 'linear']
    tip_radius: float
    lean: float
    level: List["TreeParametersSculptLevelItem"]
    leaves: int
    leaf_length: float
    leaf_width: float
    leaf_angle: float


class TreeParametersGrownLight(TypedDict, total=False):
    cell: float
    shade: float
    falloff: float
    layers: int


class _TreeParametersGrownObstaclesItemRequired(TypedDict):
    shape: Literal['box', 'sphere', 'cylinder', 'cone']


class TreeParametersGrownObstaclesItem(_TreeParametersGrownObstaclesItemRequired, total=False):
    position: List[float]
    size: List[float]


class TreeParametersGrownNeighboursItem(TypedDict):
    position: List[float]


class TreeParametersGrownLevelItem(TypedDict, total=False):
    angle: float
    angle_spread: float
    buds: int
    whorl: int
    phyllotaxis: float
    phyllotaxis_spread: float
    light: float
    tropism: float
    level_out: float
    wander: float
    length: float


TreeParametersGrown = TypedDict("TreeParametersGrown", {
    'internode': float,
    'alpha': float,
    'longest_shoot': int,
    'allocation': Literal['borchert_honda', 'priority'],
    'lambda': float,
    'lambda_old': float,
    'lambda_years': List[float],
    'priority_least': float,
    'priority_share': float,
    'light': "TreeParametersGrownLight",
    'perception_distance': float,
    'perception_angle': float,
    'bud_years': int,
    'takeover': float,
    'levels': int,
    'shed': float,
    'shed_years': int,
    'radius_exponent': float,
    'tip_radius': float,
    'clearance': float,
    'leaves': int,
    'leaf_years': int,
    'leaf_length': float,
    'leaf_width': float,
    'leaf_angle': float,
    'leaf_bend': float,
    'obstacles': List["TreeParametersGrownObstaclesItem"],
    'neighbours': List["TreeParametersGrownNeighboursItem"],
    'level': List["TreeParametersGrownLevelItem"],
}, total=False)


TreeParameters = TypedDict("TreeParameters", {
    'model': Literal['weber_penn', 'proctree', 'sculpt', 'ez_tree', 'grown'],
    'sides': int,
    'weld': bool,
    'twig_radius': float,
    'range': float,
    'trunk_flare': float,
    'roots': "TreeParametersRoots",
    'seeds': "TreeParametersSeeds",
    'leaf': "TreeParametersLeaf",
    'bark': Literal['none', 'oak_bark', 'pine_bark', 'spruce_bark', 'willow_bark', 'birch_bark', 'beech_bark', 'cherry_bark', 'palm_bark', 'cedar_bark'],
    'bark_color': str,
    'bark_seed': int,
    'bark_images': "Images",
    'bark_specular': "Specular",
    'bark_emission': "Emission",
    'age': float,
    'mature_age': float,
    'season': Literal['spring', 'summer', 'autumn', 'winter'],
    'Shape': int,
    'Levels': int,
    'Scale': float,
    'ScaleV': float,
    'BaseSize': float,
    'Ratio': float,
    'RatioPower': float,
    'Flare': float,
    'Lobes': int,
    'LobeDepth': float,
    '0Scale': float,
    '0ScaleV': float,
    '0BaseSplits': int,
    '0Branches': int,
    '0BranchDist': float,
    'AttractionUp': float,
    'PruneRatio': float,
    'PruneWidth': float,
    'PruneWidthPeak': float,
    'PrunePowerLow': float,
    'PrunePowerHigh': float,
    'sway': "TreeParametersSway",
    'Leaves': int,
    'LeafDistrib': int,
    'counting': Literal['paper', 'arbaro', 'sapling'],
    'LeafScale': float,
    'LeafScaleX': float,
    'LeafBend': float,
    '0Length': float,
    '0LengthV': float,
    '0Taper': float,
    '0SegSplits': float,
    '0SplitAngle': float,
    '0SplitAngleV': float,
    '0CurveRes': int,
    '0Curve': float,
    '0CurveBack': float,
    '0CurveV': float,
    '1DownAngle': float,
    '1DownAngleV': float,
    '1Rotate': float,
    '1RotateV': float,
    '1Branches': int,
    '1BranchDist': float,
    '1Whorl': int,
    '1BaseSize': float,
    '1Length': float,
    '1LengthV': float,
    '1Taper': float,
    '1SegSplits': float,
    '1SplitAngle': float,
    '1SplitAngleV': float,
    '1CurveRes': int,
    '1Curve': float,
    '1CurveBack': float,
    '1CurveV': float,
    '2DownAngle': float,
    '2DownAngleV': float,
    '2Rotate': float,
    '2RotateV': float,
    '2Branches': int,
    '2BranchDist': float,
    '2Whorl': int,
    '2BaseSize': float,
    '2Length': float,
    '2LengthV': float,
    '2Taper': float,
    '2SegSplits': float,
    '2SplitAngle': float,
    '2SplitAngleV': float,
    '2CurveRes': int,
    '2Curve': float,
    '2CurveBack': float,
    '2CurveV': float,
    '3DownAngle': float,
    '3DownAngleV': float,
    '3Rotate': float,
    '3RotateV': float,
    '3Branches': int,
    '3BranchDist': float,
    '3Whorl': int,
    '3BaseSize': float,
    '3Length': float,
    '3LengthV': float,
    '3Taper': float,
    '3SegSplits': float,
    '3SplitAngle': float,
    '3SplitAngleV': float,
    '3CurveRes': int,
    '3Curve': float,
    '3CurveBack': float,
    '3CurveV': float,
    'mSeed': int,
    'mSegments': int,
    'mLevels': int,
    'mVMultiplier': float,
    'mTwigScale': float,
    'mInitialBranchLength': float,
    'mLengthFalloffFactor': float,
    'mLengthFalloffPower': float,
    'mClumpMax': float,
    'mClumpMin': float,
    'mBranchFactor': float,
    'mDropAmount': float,
    'mGrowAmount': float,
    'mSweepAmount': float,
    'mMaxRadius': float,
    'mClimbRate': float,
    'mTrunkKink': float,
    'mTreeSteps': int,
    'mTaperRate': float,
    'mRadiusFalloffRate': float,
    'mTwistRate': float,
    'mTrunkLength': float,
    'sequence': Literal['keyed', 'original'],
    'ez_tree': "TreeParametersEzTree",
    'sculpt': "TreeParametersSculpt",
    'grown': "TreeParametersGrown",
}, total=False)


class WorldParametersRelief(TypedDict, total=False):
    sea: bool
    sea_level: float
    land: float
    continents: float
    mountains: float
    hills: float
    ridges: float
    gullies: float
    terraces: float


class WorldParametersWater(TypedDict, total=False):
    rivers: float
    width: float


class WorldParametersClimate(TypedDict, total=False):
    temperature: float
    moisture: float
    variation: float


class WorldParametersColors(TypedDict, total=False):
    grass: str
    forest: str
    dry: str
    rock: str
    sand: str
    snow: str
    water: str


class WorldParametersSettlementsTowns(TypedDict, total=False):
    share: float
    radius: float
    walls: float
    city: "Child"


class _WorldParametersSettlementsHousesItemRequired(TypedDict):
    model: "Child"


class WorldParametersSettlementsHousesItem(_WorldParametersSettlementsHousesItemRequired, total=False):
    share: float


class WorldParametersSettlements(TypedDict, total=False):
    density: float
    radius: float
    wall: str
    roof: str
    towns: "WorldParametersSettlementsTowns"
    houses: List["WorldParametersSettlementsHousesItem"]


class WorldParametersRoads(TypedDict, total=False):
    width: float
    longest: float
    color: str


class WorldParametersFields(TypedDict, total=False):
    share: float
    size: float
    reach: float
    colors: List[str]


_WorldParametersPlantsItemRequired = TypedDict("_WorldParametersPlantsItemRequired", {
    'class': str,
})


class WorldParametersPlantsItem(_WorldParametersPlantsItemRequired, total=False):
    form: Literal['conifer', 'broadleaf', 'palm', 'shrub', 'cactus', 'fungus']
    model: "Child"
    height: float
    spacing: float
    density: float
    moisture: List[float]
    temperature: List[float]
    slope: float
    heights: List[float]
    biomes: List[Literal['ice', 'tundra', 'taiga', 'steppe', 'grassland', 'forest', 'desert', 'savanna', 'rainforest']]
    color: str
    stem: str


class WorldParameters(TypedDict, total=False):
    extent: int
    origin: List[int]
    layers: List[Literal['terrain', 'water', 'roads', 'buildings', 'plants']]
    relief: "WorldParametersRelief"
    water: "WorldParametersWater"
    climate: "WorldParametersClimate"
    colors: "WorldParametersColors"
    settlements: "WorldParametersSettlements"
    roads: "WorldParametersRoads"
    fields: "WorldParametersFields"
    plants: List["WorldParametersPlantsItem"]


class Child(TypedDict, total=False):
    generator: str
    preset: str
    seed: "Seed"
    parameters: Dict[str, Any]


class _BuildingRequestRequired(TypedDict):
    generator: Literal['building']


class BuildingRequest(_BuildingRequestRequired, total=False):
    preset: str
    seed: "Seed"
    parameters: "BuildingParameters"
    output: "Output"


class _CityRequestRequired(TypedDict):
    generator: Literal['city']


class CityRequest(_CityRequestRequired, total=False):
    preset: str
    seed: "Seed"
    parameters: "CityParameters"
    output: "Output"


class _FractalRequestRequired(TypedDict):
    generator: Literal['fractal']


class FractalRequest(_FractalRequestRequired, total=False):
    preset: str
    seed: "Seed"
    parameters: "FractalParameters"
    output: "Output"


class _LsystemRequestRequired(TypedDict):
    generator: Literal['lsystem']


class LsystemRequest(_LsystemRequestRequired, total=False):
    preset: str
    seed: "Seed"
    parameters: "LsystemParameters"
    output: "Output"


class _SceneRequestRequired(TypedDict):
    generator: Literal['scene']


class SceneRequest(_SceneRequestRequired, total=False):
    preset: str
    seed: "Seed"
    parameters: "SceneParameters"
    output: "Output"


class _TerrainRequestRequired(TypedDict):
    generator: Literal['terrain']


class TerrainRequest(_TerrainRequestRequired, total=False):
    preset: str
    seed: "Seed"
    parameters: "TerrainParameters"
    output: "Output"


class _TreeRequestRequired(TypedDict):
    generator: Literal['tree']


class TreeRequest(_TreeRequestRequired, total=False):
    preset: str
    seed: "Seed"
    parameters: "TreeParameters"
    output: "Output"


class _WorldRequestRequired(TypedDict):
    generator: Literal['world']


class WorldRequest(_WorldRequestRequired, total=False):
    preset: str
    seed: "Seed"
    parameters: "WorldParameters"
    output: "Output"


class _PresetRequestRequired(TypedDict):
    preset: str


class PresetRequest(_PresetRequestRequired, total=False):
    seed: "Seed"
    parameters: Dict[str, Any]
    output: "Output"


Request = Union["BuildingRequest", "CityRequest", "FractalRequest", "LsystemRequest", "SceneRequest", "TerrainRequest", "TreeRequest", "WorldRequest", "PresetRequest"]

class PresetListGeneratorsItem(TypedDict):
    name: str
    title: str


class PresetListPresetsItem(TypedDict):
    name: str
    generator: str
    title: str
    description: str
    tags: List[str]


class PresetList(TypedDict):
    generators: List["PresetListGeneratorsItem"]
    presets: List["PresetListPresetsItem"]


class _WarningsItemRequired(TypedDict):
    pointer: str
    message: str


class WarningsItem(_WarningsItemRequired, total=False):
    line: int
    column: int


class ValidationEstimate2(TypedDict):
    triangles: int
    bytes: int
    exact: bool


class Validation(TypedDict):
    valid: Literal[True]
    warnings: List["WarningsItem"]
    estimate: Union[None, "ValidationEstimate2"]


class _ImportedWarningsItemRequired(TypedDict):
    pointer: str
    message: str


class ImportedWarningsItem(_ImportedWarningsItemRequired, total=False):
    line: int
    column: int


class Imported(TypedDict):
    format: Literal['arbaro', 'cpfg', 'ez_tree', 'fractint', 'geojson', 'houdini', 'osm', 'proctree', 'shapeml', 'tree_gen']
    request: "Request"
    warnings: List["ImportedWarningsItem"]


class LsystemDerivationTurtleBounds(TypedDict, total=False):
    min: List[float]
    max: List[float]


class LsystemDerivationTurtle(TypedDict, total=False):
    segments: int
    total_length: float
    position: List[float]
    heading: List[float]
    left: List[float]
    up: List[float]
    bounds: "LsystemDerivationTurtleBounds"


class LsystemDerivation(TypedDict):
    iterations: int
    length: int
    counts: Dict[str, int]
    string: str
    truncated: bool
    turtle: "LsystemDerivationTurtle"
    warnings: List["WarningsItem"]


class BuildingDerivationShapesItemScope(TypedDict):
    origin: List[float]
    axes: List[List[float]]
    size: List[float]


class _BuildingDerivationShapesItemRequired(TypedDict):
    id: int
    parent: Union[int, None]
    symbol: str
    parameters: List[Union[float, str, bool, List[Any]]]
    active: bool
    scope: "BuildingDerivationShapesItemScope"


class BuildingDerivationShapesItem(_BuildingDerivationShapesItemRequired, total=False):
    rule: str
    line: int
    choice: int


class BuildingDerivationReportsValue(TypedDict, total=False):
    count: int
    sum: float
    mean: float
    min: float
    max: float


class BuildingDerivation(TypedDict):
    shapes: List["BuildingDerivationShapesItem"]
    count: int
    truncated: bool
    reports: Dict[str, "BuildingDerivationReportsValue"]
    warnings: List["WarningsItem"]


Warnings = List["WarningsItem"]

class Box(TypedDict):
    min: List[float]
    max: List[float]


class TreeDerivationLevelsItem(TypedDict):
    count: int
    length: float
    radius: float


class TreeDerivation(TypedDict):
    limbs: int
    levels: List["TreeDerivationLevelsItem"]
    leaves: int
    height: float
    bounds: "Box"
    warnings: List["WarningsItem"]


CityDerivation = Dict[str, Any]

class WorldDerivation(TypedDict):
    levels: int
    extent: float
    origin: List[int]
    sea_level: Union[float, None]
    warnings: List["WarningsItem"]


class WorldMapHeights(TypedDict, total=False):
    columns: int
    rows: int
    values: List[float]


class WorldMapSettlementsItem(TypedDict, total=False):
    id: str
    position: List[float]
    radius: float


class WorldMapRiversItem(TypedDict, total=False):
    id: str
    into: str
    points: List[List[float]]
    widths: List[float]


class WorldMapLakesItem(TypedDict, total=False):
    id: str
    level: float
    outline: List[List[float]]


class WorldMapRoadsItem(TypedDict, total=False):
    id: str
    width: float
    points: List[List[float]]


WorldMapPlantsItem = TypedDict("WorldMapPlantsItem", {
    'class': str,
    'spacing': float,
    'count': int,
    'places': List[List[float]],
}, total=False)


class _WorldMapRequired(TypedDict):
    box: List[float]
    sea_level: Union[float, None]
    settlements: List["WorldMapSettlementsItem"]
    rivers: List["WorldMapRiversItem"]
    lakes: List["WorldMapLakesItem"]
    roads: List["WorldMapRoadsItem"]
    plants: List["WorldMapPlantsItem"]


class WorldMap(_WorldMapRequired, total=False):
    heights: "WorldMapHeights"


WorldPosition = List[float]

class FractalDerivation(TypedDict):
    pieces: Union[float, None]
    points: Union[float, None]
    dimension: Union[float, None]
    exposed_quads: Union[float, None]
    surface_area: Union[float, None]
    volume: Union[float, None]
    genus: Union[float, None]
    non_manifold_edges: Union[float, None]
    length: Union[float, None]
    area: Union[float, None]
    stages: List[Dict[str, Any]]
    bounds: Union["Box", None]
    warnings: List["WarningsItem"]


class _TerrainDerivationRequired(TypedDict):
    width: Union[int, None]
    height: Union[int, None]
    min: float
    max: float
    heights: Union[List[float], None]
    warnings: List["WarningsItem"]


class TerrainDerivation(_TerrainDerivationRequired, total=False):
    mean: float
    samples: int
    engines: Union[Dict[str, Any], None]


class SceneDerivationPlacementsItem(TypedDict):
    model: str
    translation: List[float]
    rotation: List[float]
    scale: List[float]


class SceneDerivationLayersItem(TypedDict):
    name: str
    placed: int


class SceneDerivation(TypedDict):
    placements: List["SceneDerivationPlacementsItem"]
    models: Dict[str, Dict[str, Any]]
    layers: List["SceneDerivationLayersItem"]
    warnings: List["WarningsItem"]
