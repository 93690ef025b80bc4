// Generated from api_schema by clients/generate_types.py. Do not edit.

/** The form of the response. */
export interface Output {
  /** The file format of the response. glb is one binary glTF 2.0 file. gltf is glTF 2.0 as JSON with embedded buffers. zip contains a .gltf, its .bin and its images as separate files, stored uncompressed. Terrain also has height maps: png16 and png8 are grey, rgb24 and rgba32 pack a height into the channels of a PNG, and r16 has raw samples of 16 bits. Fractals also have ply (the points of frcm), png16 and png8 (escape times, grey or in colours). Scenes also have placements, a zip of placements.json and every model as a file of its own. Cities also have geojson, the plan. */
  format?: "glb" | "gltf" | "zip" | "png16" | "png8" | "rgb24" | "rgba32" | "r16" | "ply" | "placements" | "geojson";
  /** The program that reads the model. core: any reader of glTF 2.0, without required extensions. web: three.js, Babylon and other viewers, with quantized and compressed data and instances on the GPU. tiles: clients of 3D Tiles, with quantized data and instances on the GPU, without a compression that needs a decoder. unity, unreal, godot, blender: what the importer of that program supports, with names that it accepts. For height maps as r16 or png16, unity and unreal select the conventions of these engines for sizes, rows and scales. */
  profile?: "core" | "web" | "tiles" | "unity" | "unreal" | "godot" | "blender";
  /** The name of the model: of its root node, its scene and its files, and the first part of the names of its meshes, materials and images. Without it, the name is that of the preset. If only the seed differs from the preset, the seed is appended; if anything else differs, a hash of the request. A request without a preset has the generator's name and a hash. */
  name?: string;
  /** What the model states about its origin. full writes the engine, generator, seed, preset, canonical request and permalink into the extras of the asset, the scene and the root node. none leaves all of it out. */
  provenance?: "full" | "none";
  /** none adds no animation. growth adds a skin and an animation in which the plant grows from a seed to its full size. */
  animation?: "none" | "growth";
  /** The width and height of generated textures in texels, a power of two. Images of leaves, and of dirt on facades, have half this size. An image of occlusion and roughness has half the size of the other images of its material. none leaves out all textures, including those of the request. links names generated textures of 512 texels by URLs of this service, which are immutable and shared by all models; the formats are glb and gltf, without an impostor. */
  textures?: number | "none" | "links";
  /** The file format of generated images. png: every reader. webp: about a tenth of the size, for readers of EXT_texture_webp, which the file then requires. both: WebP, and PNG for readers without it. auto: webp in the profile web, else png. Images of the request keep their format. */
  image_format?: "auto" | "png" | "webp" | "both";
  /** The number of levels of detail, each coarser than the one before, or a list with one entry for each level in descending order. Entries up to 1 are shares of the triangles of the whole model; entries above 1 are numbers of triangles. Examples are [1, 0.5, 0.15, 0.03] and [20000, 5000, 800]. More than one level requires the format zip, which has a file for each, or a profile that has them in one file (MSFT_lod): web or unity. In the profiles unity and unreal, vertices then have _NEXT_POSITION, their position on the next level, which adds 12 bytes a vertex. */
  lods?: number | number[];
  /** Adds an impostor of each plant as its coarsest level of detail: 12 triangles and a texture of the size `textures`, or half of it in a scene. It requires the format zip, or the profile web or unity. */
  impostor?: boolean;
  /** weights writes the values that a shader needs to move a plant in the wind: TEXCOORD_2 = (bend of the trunk, bend of the branch), TEXCOORD_3 = (phase of the branch, flutter of the leaf), each from 0 to 1. Vertices at the same position have the same values, so that no gap opens. */
  wind?: "none" | "weights";
  /** Adds convex bodies around the trunk and the thick limbs of a tree or an L-system, or around the masses of a building. The value selects the names that an engine recognises as collision: plain (collision_01), unreal (UCX_bark_01, after the visible mesh), godot (collision_01-convcolonly). */
  collision?: "none" | "plain" | "unreal" | "godot";
  /** How repeated parts are written. merge makes one mesh of all organs of a kind, and of all copies with one material. nodes gives each copy a node, and all share one mesh. gpu writes the transforms of copies as arrays (EXT_mesh_gpu_instancing), for the profiles web, tiles, unity and blender. auto merges the organs of a plant, and parts of a building except large ones that occur often. Other copies are nodes, or arrays in the profiles web and tiles. */
  instancing?: "auto" | "nodes" | "gpu" | "merge";
  /** The number of models side by side in one file, generated from this seed and the seeds that follow it. They share materials and textures. */
  variants?: number;
  /** The greatest number of triangles of the finest level, copies included. A larger model is made coarser until it fits, by a coarser level of detail or by edge collapse. If that is not possible, the request is refused. */
  max_triangles?: number;
  /** Tangents of the vertices. auto makes them if a material has a normal map. none leaves them out, which saves 16 bytes for each vertex; readers of the file then compute their own, and the validator of Khronos warns that these may differ (MESH_PRIMITIVE_GENERATED_TANGENT_SPACE). */
  tangents?: "auto" | "none";
}

/** One error, tied to the value in the request that caused it. */
export interface ProblemErrorsItem {
  /** JSON Pointer (RFC 6901) into the request body; a missing property points at the object that lacks it, the empty pointer is the whole body. */
  pointer: string;
  /** The kind of error, for programs. syntax: a text cannot be read. duplicate_key: a key or a name is given twice. unknown_key: the object has no such member. unknown_name: a name refers to nothing. missing: something required is absent. wrong_type: another type is expected. out_of_range: a number, a length or a count is outside its range. invalid_value: the value cannot be used. conflict: values exclude each other, or one needs another. not_available: the generator, format or profile does not offer it. evaluation: an expression or a rule has no usable result. limit: a limit is exceeded, see resource. truncated_list: see unlisted. deadline: the time limit has passed. cancelled: the client has disconnected. internal: the service has an error; only its log shows the cause. */
  code: "syntax" | "duplicate_key" | "unknown_key" | "unknown_name" | "missing" | "wrong_type" | "out_of_range" | "invalid_value" | "conflict" | "not_available" | "evaluation" | "limit" | "truncated_list" | "deadline" | "cancelled" | "internal";
  /** What was found and what was expected, for people. The words may change; programs read the code. */
  message: string;
  /** Line inside the text that the pointer names, from 1; only for errors inside a text. */
  line?: number;
  /** Column inside that line in characters, from 1; only for errors inside a text. */
  column?: number;
  /** The limited resource; only with the code limit. */
  resource?: "modules" | "shapes" | "triangles" | "output_bytes" | "memory_bytes" | "file_bytes" | "vertices" | "points" | "segments" | "joints" | "leaves" | "iterations" | "depth" | "json_values" | "steps";
  /** The greatest amount of the resource that is allowed; only with the code limit. */
  limit?: number;
  /** The request needs at least this much of the resource; only with the code limit. */
  needed?: number;
  /** How many more errors were found than are listed; only with the code truncated_list. */
  unlisted?: number;
}

/** Why a request was refused, after RFC 9457 (application/problem+json). */
export interface Problem {
  /** Identifies the kind of problem; its last word is stable, for example invalid-request, limit-exceeded or deadline-exceeded. */
  type: string;
  /** The kind of problem in a few words, the same for all problems of one type. */
  title: string;
  /** The HTTP status code. */
  status: number;
  /** What went wrong this time, in a sentence. */
  detail?: string;
  /** Identifies this one refusal: the request id, as in the header X-Request-Id. */
  instance?: string;
  /** The format as which an imported file was read, if the request did not name the format. */
  format?: string;
  /** Every error of the request, all at once: at most the first 100, and then one entry with the code truncated_list. */
  errors?: ProblemErrorsItem[];
}

/** One solid. */
export interface FigureSolidsItem {
  /** The kind of solid. */
  solid?: "box" | "cylinder" | "cone" | "sphere" | "pyramid" | "prism" | "triangular_prism";
  /** The centre of its base, in two dimensions its centre. Default: the origin. */
  at?: (number | string)[];
  /** Its sizes along x, y (up) and z, in two dimensions along x and y, or one number for all. Default: 1. */
  size?: (number | string)[];
  /** Angles in degrees: in two dimensions one number; else one about the vertical axis, or three about x, then y, then z. */
  turn?: (number | string)[];
  /** The name of its material. Solids of different materials do not match. */
  material?: string;
}

/** One marker. */
export interface FigureMarkersItem {
  /** Its label. */
  name: string;
  /** One to three points. Their order matters. */
  points: ((number | string)[])[];
}

/** One member of a family, translated, rotated, scaled or mirrored. */
export interface FigureShapesItem {
  /** The name of the family. */
  shape: string;
  /** Values for the parameters of the family: numbers, or expressions over the parameters of this figure. */
  values?: { [key: string]: number | string };
  /** The position of its origin. */
  at?: (number | string)[];
  /** Angles in degrees: in two dimensions one number; else one about the vertical axis, or three about x, then y, then z. */
  turn?: (number | string)[];
  /** The factor of its size: a number above 0, or an expression. */
  scale?: number | string;
  /** Whether x is mirrored before everything else. */
  mirror?: boolean;
}

/** A figure: lines, solids, markers and members of families. */
export interface Figure {
  /** Named numbers for the coordinates of this figure. They make a figure of `shapes` a family: each use can give them other values. */
  parameters?: { [key: string]: number };
  /** Polylines, each as a row of points. Lines that overlap or continue each other become one line. */
  lines?: (((number | string)[])[])[];
  /** Solids. Rules match whole solids, as in a set grammar. In two dimensions they are boxes (rectangles) and cylinders (circles). */
  solids?: FigureSolidsItem[];
  /** Labelled points that rules match: the nonterminal shapes. A marker of two or three points is an arrow or a corner, which also has a direction and a size. */
  markers?: FigureMarkersItem[];
  /** Members of families of shapes that are part of this figure. */
  shapes?: FigureShapesItem[];
}

/** A variable of a left shape. */
export interface BuildingParametersShapeGrammarRulesItemOpenItem {
  /** The name of the variable in the coordinates of both shapes and in the condition. */
  name: string;
  /** Matches with a lower value do not count. */
  low?: number;
  /** Matches with a higher value do not count. */
  high?: number;
}

/** A left and a right shape. */
export interface BuildingParametersShapeGrammarRulesItem {
  /** The name of the rule in reports, which count how often each rule was used. */
  name?: string;
  /** The weight of the rule in the random choice between rules that match. */
  weight?: number;
  /** Variables of both shapes whose values each match determines, so that a left shape has open proportions. The coordinates of the left shape have to be linear in these variables. The transformation of the match already determines size, position and direction. At least one length of the left shape therefore has to be a number. */
  open?: BuildingParametersShapeGrammarRulesItemOpenItem[];
  /** An expression over the open variables. Matches for which it is 0 do not count. Without one, all count. */
  condition?: string;
  /** The left shape, which is matched, and the right shape, which replaces it. */
  pair: [Figure, Figure];
}

/** A general shape grammar after Stiny and Gips (1972) instead of rules: pairs of labelled shapes in two or three dimensions. The left shape of a pair matches if it is part of the current figure after a translation, rotation, scaling or reflection. Lines also match within longer lines; solids and markers match as a whole. The right shape replaces it. iterations, derivation.mode and restrict apply to it. */
export interface BuildingParametersShapeGrammar {
  /** 2: points are x and y, seen from above; 3: x, y (up) and z. */
  dimensions?: number;
  /** Shapes by name, with variables for coordinates: each use is a member with values of its own. */
  shapes?: { [key: string]: Figure };
  /** The pairs. */
  rules: BuildingParametersShapeGrammarRulesItem[];
  /** The initial figure, as the union of these figures. */
  initial: Figure[];
  /** Whether left shapes also match mirrored. */
  mirror?: boolean;
  /** The width and height of drawn lines. */
  width?: number;
  /** The height of drawn solids of two dimensions. */
  height?: number;
  /** The name of the material. */
  material?: string;
  /** The diameter of the spheres that show markers; 0 shows none. */
  marker_size?: number;
}

/** The change of one shape. */
export interface BuildingParametersEditsItem {
  /** The path of the shape: names from the first shape on, each with its number among shapes of that name. */
  shape: string;
  /** Values of attributes for this shape and for all shapes that rules make from it. */
  attributes?: { [key: string]: number | string | boolean };
  /** The symbol whose rule replaces the shape, instead of its own. A symbol without a rule makes it a part of the result. */
  rule?: string;
  /** Whether the shape is left out, with all shapes that rules would make from it. */
  remove?: boolean;
}

/** The order in which shapes are replaced. It affects the steps only; the finished model is the same. */
export interface BuildingParametersDerivation {
  /** breadth: the oldest shape first, lower PRIORITY numbers before all others. depth: the newest shape first, so that a part is finished before the next begins. */
  order?: "breadth" | "depth";
  /** parallel: a step replaces every shape that has a rule. sequential: a step replaces one. */
  mode?: "parallel" | "sequential";
}

/** Light that the surface sends out. It is added to the light that it reflects, and does not light other surfaces. */
export interface Emission {
  color: string;
  /** The factor of the colour. Light beyond 1 is written as KHR_materials_emissive_strength, which some readers ignore. */
  strength?: number;
}

/** Colour and strength of reflections on a surface that is not a metal. It is written as KHR_materials_specular, which some readers ignore. */
export interface Specular {
  color: string;
  /** 1 reflects as much as usual surfaces that are not metal, 0 nothing. */
  strength?: number;
}

/** Your own textures, each a PNG or JPEG file as a data URI. They replace a generated texture. */
export interface Images {
  /** The colour, and with an alpha channel the shape that is cut out. */
  color?: string;
  /** Normals in tangent space, +y up in the image. */
  normal?: string;
  /** Occlusion in red, roughness in green, metallic in blue, as glTF packs them. */
  surface?: string;
  /** Whether the alpha of the colour cuts the shape out, as for a leaf, with both sides visible. Leaves of trees are cut out automatically if their image has alpha. */
  cut_out?: boolean;
}

/** One material. */
export interface BuildingParametersMaterialsValue {
  color?: string;
  /** 0 is a mirror, 1 is chalk. */
  roughness?: number;
  /** 1 is bare metal. */
  metallic?: number;
  /** Values below 1 are transparent. */
  opacity?: number;
  emission?: Emission;
  specular?: Specular;
  /** The width and height of one tile of the images on the wall. */
  tile?: [number, number];
  images?: Images;
  /** Generated textures in the colour of the material: colour, normals, and roughness with occlusion. They replace the numbers roughness and metallic. auto: the name of the material selects the kind, if `textures` allows it. Images take precedence. */
  texture?: "auto" | "none" | "brick" | "plaster" | "roof_tile" | "slate" | "planks" | "ashlar" | "concrete" | "sheet" | "panels" | "dressed_stone" | "paint" | "brick_bay" | "plaster_bay" | "planks_bay" | "ashlar_bay";
  /** Another seed gives another texture of the same kind. */
  texture_seed?: number;
}

/** A nested request or a GLB file. */
export interface BuildingParametersAssetsValue {
  model?: Child;
  /** A GLB file as data URI. */
  glb?: string;
}

/** Shape and split grammars after Stiny, Wonka and Müller (CGA): rules cut a box or a footprint into floors, facades, windows and doors. Rules are written as in CityEngine, or as in Müller, Wonka, Haegler, Ulmer and Van Gool, Procedural Modeling of Buildings (2006). */
export interface BuildingParameters {
  /** The rules as text, in either notation: predecessor(parameters) --> case condition: successor else: successor, or id : predecessor(parameters) : condition ~> successor : probability. Several rules can share a line. //, # and /* *\/ are comments. attr declares an attribute, const a constant. An object has several rule files by name, which can import each other. The main file is the one that no other file imports. */
  rules?: string | { [key: string]: string };
  /** Tables that rules read with readStringTable, readFloatTable and readTextFile: texts with one row on each line and cells between commas, semicolons or tabulators. */
  tables?: { [key: string]: string };
  /** Built-in rules instead of your own. Their attributes change the building. */
  blueprint?: "church" | "factory" | "house" | "office_tower" | "parisian_block" | "skyscraper" | "temple" | "terraced_house" | "villa" | "warehouse";
  /** A general shape grammar after Stiny and Gips (1972) instead of rules: pairs of labelled shapes in two or three dimensions. The left shape of a pair matches if it is part of the current figure after a translation, rotation, scaling or reflection. Lines also match within longer lines; solids and markers match as a whole. The right shape replaces it. iterations, derivation.mode and restrict apply to it. */
  shape_grammar?: BuildingParametersShapeGrammar;
  /** The symbol of the first shape. Default: that of the rule after @StartRule, or of the first rule. */
  start?: string;
  /** The size of the first shape in x, y (up) and z. It is a box on the ground, centred on the origin, or a flat lot if the height is 0. */
  size?: [number, number, number];
  /** A polygon on the ground instead of the size, as GeoJSON rings of points [x, z]: the outer ring first, then holes. Rings can have either direction, and can repeat their first point at the end. All rings together have at most 5000 points; a request with more exceeds a limit. */
  footprint?: (([number, number])[])[];
  /** Values for the attributes that the rules declare with attr. They replace the values in the rules. */
  attributes?: { [key: string]: number | string | boolean };
  /** Changes of single shapes. A shape is found by the path that derive lists, which stays the same when other shapes change. */
  edits?: BuildingParametersEditsItem[];
  /** The number of steps of the derivation: rounds over all shapes (parallel) or single rules (sequential). Shapes that still have a rule afterwards are shown as they are. Default: until no shape has a rule. */
  iterations?: number;
  /** The order in which shapes are replaced. It affects the steps only; the finished model is the same. */
  derivation?: BuildingParametersDerivation;
  /** The number of copies of a repeat whose cells can stretch. nearest: the number that stretches them least (CityEngine). ceil: the least number for which no copy is larger than its size (2006). Default: ceil for Repeat(…), nearest for split { … }*. */
  repeat?: "nearest" | "ceil";
  /** normalize: probabilities that do not sum to 1 count as shares of their sum, with a warning. strict: they are an error, also where conditions, attributes or random numbers decide on them. */
  weights?: "normalize" | "strict";
  /** A restricted kind of shape grammar. non_erasing: no rule removes a shape (NIL). unimarker: in addition, each successor has at most one symbol with a rule, the marker. split: every shape of a successor stays within the scope of its predecessor. Rules that satisfy the restriction make the same model as without it. */
  restrict?: "none" | "non_erasing" | "unimarker" | "split";
  /** The materials that rules name. They replace built-in materials of the same name. */
  materials?: { [key: string]: BuildingParametersMaterialsValue };
  /** An image for the walls, in place of those of their style: a PNG or JPEG file as a data URI. It repeats over all upright faces whose material is a wall (brick, plaster, wall, facade, building, stone, concrete, wood, cladding). */
  facade_image?: string;
  /** The width and height of one copy of `facade_image` on the wall. */
  facade_tile?: [number, number];
  /** Whether materials with certain names get generated textures (brick, plaster, wall, facade, building, stone, concrete, wood, roof, roof_tile, slate, cladding, chimney). auto: only in blueprints. made: in your own rules, too. none: only materials with images have textures. Built-in parts, such as doors, have textures in blueprints only; with made, panes of glass have one, too. */
  textures?: "auto" | "made" | "none";
  /** Models that rules insert by name, as in i("statue"): a nested request, or a GLB file as data URI. */
  assets?: { [key: string]: BuildingParametersAssetsValue };
}

/** The area that is partitioned. */
export interface CityParametersArea {
  /** The extent to the east and to the north of a rectangle about the origin. */
  size?: [number, number];
  /** A polygon instead of the size, as GeoJSON rings of points [east, north]: the outer ring first, then holes. Rings can have either direction, and can repeat their first point at the end. All rings together have at most 5000 points. */
  polygon?: (([number, number])[])[];
}

/** A name and its area. */
export interface CityParametersMapsZonesItem {
  /** The name. */
  zone: string;
  /** Where the zone is: an expression over x (east) and y (north), a PNG image as data URI, or polygons. The brightness of an image covers the box around the area. The zone is where the value is 0.5 or more. */
  area: string | { [key: string]: unknown };
}

/** Quantities that vary over the area. */
export interface CityParametersMaps {
  /** The density of people, from 0 to 1: an expression over x (east) and y (north) in metres, a PNG image as data URI, or polygons with density 1. The brightness of an image covers the box around the area. Streets avoid positions below 0.1; blocks there become parks. */
  density?: string | { [key: string]: unknown };
  /** Where there is water: an expression, an image or polygons. There is water where the value is at least 0.5. Water is part of the partition. Streets end before it or cross it on bridges. */
  water?: string | { [key: string]: unknown };
  /** Where no street may grow and nothing is built: an expression, an image or polygons. An obstacle is where the value is at least 0.5. */
  obstacles?: string | { [key: string]: unknown };
  /** The share of streets.second_pattern in the pattern of the streets, from 0 to 1, as an expression, an image or polygons with the value 1. At values between 0 and 1, directions follow from the weighted mean of the tensors of both patterns. Only for the method growth. */
  pattern?: string | { [key: string]: unknown };
  /** Named zones, which rules of buildings can use. Where zones overlap, the first one counts. Wards have zones of their own. */
  zones?: CityParametersMapsZonesItem[];
  /** The height of the natural ground, instead of a terrain: an expression over x (east) and y (north) with the height in metres, a PNG image as data URI, or polygons. The brightness of an image covers the box around the area. height_range has the heights of images and polygons. */
  height?: string | { [key: string]: unknown };
  /** The heights of black and white pixels of an image, or the heights outside and inside of polygons. An expression gives metres itself and does not use this range. */
  height_range?: [number, number];
}

/** Existing parts of the city as GeoJSON in local metres. They stay as they are, and the rest grows from them. */
export interface CityParametersGiven {
  /** Existing streets: LineString, MultiLineString, or a GeometryCollection of them. The value is a FeatureCollection, a Feature or a geometry of GeoJSON in metres, east and north. Members that RFC 7946 does not define have no effect. The properties `class` (highway, major, minor or lane), `width`, `lanes`, `sidewalk` (one number, or left and right), `level`, `bridge` and `tunnel` are used. Without `class`, the tag `highway` of OpenStreetMap selects the class. Where two streets meet or cross on one level, an end or corner of one has to lie within 3 m of the other. */
  streets?: { [key: string]: unknown };
  /** Existing water: Polygon, MultiPolygon, or a GeometryCollection of them. The value is a FeatureCollection, a Feature or a geometry of GeoJSON in metres, east and north. Members that RFC 7946 does not define have no effect. */
  water?: { [key: string]: unknown };
  /** Existing buildings: Polygon, MultiPolygon, or a GeometryCollection of them. The value is a FeatureCollection, a Feature or a geometry of GeoJSON in metres, east and north. Members that RFC 7946 does not define have no effect. The property `height` is the height of the walls in metres. Without it, each of the `floors` or `building:levels` has 3 m. Without all three, walls have 9 m. Streets that grow keep clear of the buildings, and no house is built on them. */
  footprints?: { [key: string]: unknown };
}

/** The cross section of highways: given streets of this class, and lines of the net at highway_spacing. */
export interface CityParametersStreetsClassesHighway {
  /** The width of the carriageway. */
  width?: number;
  /** The number of lanes. */
  lanes?: number;
  /** The width of the sidewalk of each side. */
  sidewalk?: number;
  /** The steepest grade of these streets, as rise over run. On a terrain, the ground is cut and filled to keep it. No street grows where the grade of the natural ground is more than 1.5 times this value. */
  grade?: number;
  /** The distance between trees along each side of these streets. 0: no trees. Default: that of furniture.trees, if it is given. */
  trees?: number;
}

/** The cross section of this class of streets. */
export interface CityParametersStreetsClassesMajor {
  /** The width of the carriageway. */
  width?: number;
  /** The number of lanes. */
  lanes?: number;
  /** The width of the sidewalk of each side. */
  sidewalk?: number;
  /** The steepest grade of these streets, as rise over run. On a terrain, the ground is cut and filled to keep it. No street grows where the grade of the natural ground is more than 1.5 times this value. */
  grade?: number;
  /** The distance between trees along each side of these streets. 0: no trees. Default: that of furniture.trees, if it is given. */
  trees?: number;
}

/** The cross section of this class of streets. */
export interface CityParametersStreetsClassesMinor {
  /** The width of the carriageway. */
  width?: number;
  /** The number of lanes. */
  lanes?: number;
  /** The width of the sidewalk of each side. */
  sidewalk?: number;
  /** The steepest grade of these streets, as rise over run. On a terrain, the ground is cut and filled to keep it. No street grows where the grade of the natural ground is more than 1.5 times this value. */
  grade?: number;
  /** The distance between trees along each side of these streets. 0: no trees. Default: that of furniture.trees, if it is given. */
  trees?: number;
}

/** The cross section of lanes: given streets of this class, and the share lane_share of the minor streets. */
export interface CityParametersStreetsClassesLane {
  /** The width of the carriageway. */
  width?: number;
  /** The number of lanes. */
  lanes?: number;
  /** The width of the sidewalk of each side. */
  sidewalk?: number;
  /** The steepest grade of these streets, as rise over run. On a terrain, the ground is cut and filled to keep it. No street grows where the grade of the natural ground is more than 1.5 times this value. */
  grade?: number;
  /** The distance between trees along each side of these streets. 0: no trees. Default: that of furniture.trees, if it is given. */
  trees?: number;
}

/** The cross sections of the streets. */
export interface CityParametersStreetsClasses {
  /** The cross section of highways: given streets of this class, and lines of the net at highway_spacing. */
  highway?: CityParametersStreetsClassesHighway;
  /** The cross section of this class of streets. */
  major?: CityParametersStreetsClassesMajor;
  /** The cross section of this class of streets. */
  minor?: CityParametersStreetsClassesMinor;
  /** The cross section of lanes: given streets of this class, and the share lane_share of the minor streets. */
  lane?: CityParametersStreetsClassesLane;
}

/** A base field. */
export interface CityParametersStreetsTensorFieldsItem {
  /** grid: one direction. radial: along and across the rays from the position. boundary: along the nearest shore, or the nearest border of an area without water. polyline: along the nearest piece of a line. height: along the contours of the ground, the stronger the steeper it is. */
  type?: "grid" | "radial" | "boundary" | "polyline" | "height";
  /** The centre of the field, east and north. */
  position?: [number, number];
  /** The direction of a grid, counter-clockwise from east. */
  angle?: number;
  /** The distance from the position, the boundary or the line at which the weight is exp(-1) of its greatest value. 0: the same weight everywhere. */
  size?: number;
  /** The greatest weight of the field in the sum of all fields. */
  weight?: number;
  /** The corners of a polyline, east and north. */
  points?: ([number, number])[];
}

/** The tensor field of the method tensor. */
export interface CityParametersStreetsTensor {
  /** Base fields, which are added by weight. A weak grid at the angle of the streets lies below them. */
  fields?: CityParametersStreetsTensorFieldsItem[];
  /** The approximate share of the crossings of major streets that become T-junctions: one of their four streets is left out. */
  t_junctions?: number;
}

/** The wards of a medieval town about the centre. */
export interface CityParametersStreetsWards {
  /** The greatest number of wards, square and citadel included. There are fewer if the border or water leaves no space for more. */
  count?: number;
  /** The square root of the mean area of a ward. */
  size?: number;
  /** The greatest number of gates in the wall. Gates are at least 70 m apart. */
  gates?: number;
  /** Whether one ward at the wall is a citadel: one lot without minor streets. */
  citadel?: boolean;
  /** The height of the town wall. 0: no wall. */
  wall_height?: number;
}

/** The growth of the streets. */
export interface CityParametersStreets {
  /** growth: an extended L-system. tensor: major streets follow the lines of a tensor field, and minor streets grow along it. wards: a medieval town of wards with a wall, gates, a square and a citadel; minor streets grow within the wards. given: the given streets alone. */
  method?: "growth" | "tensor" | "wards" | "given";
  /** The productions of the street L-system, in the notation of the generator lsystem. The modules are R(delay, rule), the tip of a road; B(delay, rule, road), a delayed branch; and I(road, state), the query that checks a proposed road. States are UNASSIGNED, SUCCEED and FAILED. { globalGoals(rule, road) } sets pDel0 to pDel2, pRule0 to pRule2 and pRoad0 to pRoad2: straight on, to the left, to the right. { localConstraints(road) } sets state. Default: those of Parish and Müller. */
  productions?: string[];
  /** The pattern of the major streets. organic: an irregular net. raster: right angles, also for minor streets unless minor_pattern selects another pattern. radial: rings and rays about the centre. slope: along the contours of the ground and straight up its slope; a raster on level ground. */
  pattern?: "organic" | "raster" | "radial" | "slope";
  /** The pattern where maps.pattern is 1. Default: raster, or organic if the pattern is raster. */
  second_pattern?: "organic" | "raster" | "radial" | "slope";
  /** The pattern of the minor streets between the major ones. Default: that of the major streets. */
  minor_pattern?: "organic" | "raster" | "radial" | "slope";
  /** The direction of the raster, counter-clockwise from east. */
  angle?: number;
  /** The centre of the net of major streets, east and north, and the position where growth starts. */
  centre?: [number, number];
  /** The distance between neighbouring major streets. */
  major_spacing?: number;
  /** The distance between highways. In a net they are the lines through the centre and others at this distance; along a tensor field they are streamlines about this far apart. They are always built. 0: no highways. */
  highway_spacing?: number;
  /** The spacing of the streets of a raster across and along its direction. */
  block?: [number, number];
  /** The share of the streets of a raster, and of the major streets, that are built. */
  fill?: number;
  /** The mean length of a minor street between two branches. */
  length?: number;
  /** The greatest deviation from the mean length, as a share of it. */
  length_spread?: number;
  /** The probability of a branch to either side at the end of each piece of a minor street. */
  branch_probability?: number;
  /** The greatest turn of a minor street over its mean length, and of a major street over its spacing. */
  bend?: number;
  /** The greatest deviation of a branch from a right angle. */
  noise?: number;
  /** The greatest shift of the crossings of major streets, as a share of their spacing. Organic patterns only. */
  jitter?: number;
  /** A street that ends within this distance of another one joins it. */
  snap?: number;
  /** The least distance between the end of a street and streets that it does not join. */
  clearance?: number;
  /** The least angle between two streets at a junction. */
  minimal_angle?: number;
  /** The share of the ends without a connection that stay dead ends. The others are joined to a street in reach or removed. */
  dead_ends?: number;
  /** The share of the connections to major streets that minor streets on both sides prefer alike, so that they form crossings instead of T-junctions. */
  crossings?: number;
  /** The share of the minor streets, from one junction to the next or to a dead end, that are lanes: alleys with the narrow cross section of their class. */
  lane_share?: number;
  /** The share of the junctions of major streets, where there is space around them, that become roundabouts. Not for wards. */
  roundabouts?: number;
  /** The radius of the middle of their carriageway. */
  roundabout_radius?: number;
  /** The cross sections of the streets. */
  classes?: CityParametersStreetsClasses;
  /** The greatest length of a bridge. 0: no bridges. */
  bridge_length?: number;
  /** The greatest length of a tunnel. Where a ridge is too steep for a street of the net or along a tensor field, the street passes it in a straight tunnel. 0: such streets are left out. */
  tunnel_length?: number;
  /** The tensor field of the method tensor. */
  tensor?: CityParametersStreetsTensor;
  /** The wards of a medieval town about the centre. */
  wards?: CityParametersStreetsWards;
}

/** The division of the blocks. */
export interface CityParametersLots {
  /** recursive: blocks are halved until the pieces are small enough, and no cut takes the street access of a piece. offset: the same along the streets, around inner lots without access. skeleton: strips along the streets by the straight skeleton, cut at right angles to them. burgage: the same with narrow, deep lots; those wider than 2.1 to 2.6 times the least width are cut again. none: each block is one lot. */
  method?: "recursive" | "offset" | "skeleton" | "burgage" | "none";
  /** The least and the greatest area of a lot. A piece that cannot be cut without breaking another rule stays larger. */
  area?: [number, number];
  /** The least frontage along streets and the least side of a lot. */
  width?: number;
  /** The depth of the lots around inner lots. */
  offset_width?: number;
  /** The spread of the cuts about the middle. */
  irregularity?: number;
  /** The width of the cut across the corners of blocks, which becomes a part of the sidewalk. 0: corners stay. Blocks without space for it keep their corners. */
  corner_width?: number;
  /** Only corners of blocks with at most this inner angle are cut. */
  corner_angle?: number;
  /** Consecutive edges of a block that turn by at most this angle are one front: their lots form one strip. */
  simplify?: number;
  /** The share of the blocks that become parks. */
  park_share?: number;
}

/** What may stand on lots of a kind. */
export interface BuildingRule {
  /** Built-in rules of the generator building. */
  blueprint?: "church" | "factory" | "house" | "office_tower" | "parisian_block" | "skyscraper" | "temple" | "terraced_house" | "villa" | "warehouse";
  /** A request of the generator building instead of the blueprint: a preset, or rules of your own. Its size becomes that of the lot's building. */
  building?: Child;
  /** Values for attributes of the blueprint or of the request. */
  attributes?: { [key: string]: number | string | boolean };
  /** The attribute of the request that receives the number of floors. Default: none. */
  floors_as?: string;
  /** The weight of this rule among those that apply. */
  weight?: number;
  /** The range of the density at the lot, from and to. */
  density?: [number, number];
  /** The range of the distance from the centre of the streets. */
  distance?: [number, number];
  /** The range of the area of the lot. */
  lot?: [number, number];
  /** The range of the length of the lot along streets. */
  frontage?: [number, number];
  /** The classes of the street at the front. Empty: all classes. */
  streets?: ("highway" | "major" | "minor" | "lane")[];
  /** The least and the greatest number of floors. */
  floors?: [number, number];
  /** The least distance from the street. */
  front?: number;
  /** The least distance from the neighbours; 0 for houses that touch. */
  side?: number;
  /** Whether the building is as wide as the lot allows to the centimetre. Otherwise widths are whole metres, so that buildings share models. */
  shared_walls?: boolean;
  /** The least distance from the end of the lot. */
  rear?: number;
  /** The least and the greatest width of the building along the front. On a lot without space for the least, nothing is built. */
  width?: [number, number];
  /** The least and the greatest depth of the building. On a lot without space for the least, nothing is built. */
  depth?: [number, number];
  /** The greatest share of the lot that is built over. */
  share?: number;
  /** The zones of the lots. Empty: all zones. Zones of wards are citadel, merchants, patricians, craftsmen and poor. */
  zones?: string[];
}

/** A model at a position. */
export interface CityParametersBuildingsLandmarksItem {
  /** Any request. */
  model: Child;
  /** East and north. */
  position: [number, number];
  /** Counter-clockwise from above. */
  turn?: number;
  /** lot: the model stands on the lot at its position. block: the whole block there stays one lot. square: the whole block there is a paved square. free: lots stay as they are. */
  plot?: "lot" | "block" | "square" | "free";
  /** The distance at which trees of parks keep away. */
  radius?: number;
}

/** The buildings of the lots. */
export interface CityParametersBuildings {
  /** For each lot, one of the rules whose conditions hold is drawn by weight. An empty list makes no buildings. Default: houses, terraced houses and office towers by density. */
  rules?: BuildingRule[];
  /** The number of seeds among which each building chooses. Buildings of one rule, size, number of floors and seed share one model. Widths are whole metres, and depths have steps of 2 m. */
  variants?: number;
  /** The attribute lod of blueprints: 0 everything, 1 flat windows and doors, 2 the mass alone. */
  detail?: number;
  /** Models at given positions. On a lot, the model replaces the lot's building; in parks and on squares, trees keep away from it. */
  landmarks?: CityParametersBuildingsLandmarksItem[];
}

/** Surface */
export interface CityParametersSurfacesItem {
  /** The name of the material in the model. */
  name: "asphalt" | "junction" | "sidewalk" | "verge" | "park" | "square" | "lot" | "water" | "marking" | "wall" | "foundation" | "bridge" | "tunnel";
  color?: string;
  /** 0 reflects like still water, 1 is matt. */
  roughness?: number;
  specular?: Specular;
  emission?: Emission;
}

/** Street lamps at the kerbs, on both sides in turn. */
export interface CityParametersFurnitureLamps {
  /** The distance between positions along one side of a street. */
  spacing?: number;
  /** The share of the positions that are used. A random number for each position decides. */
  share?: number;
  /** Requests among which each position chooses. Empty: a built-in model. */
  models?: Child[];
}

/** Trees along kerbs with sidewalks of at least 1.5 m, at least 8 m away from junctions. */
export interface CityParametersFurnitureTrees {
  /** The distance between positions along one side of a street. */
  spacing?: number;
  /** The share of the positions that are used. A random number for each position decides. */
  share?: number;
  /** Requests among which each position chooses. Empty: a built-in model. */
  models?: Child[];
}

/** Benches on sidewalks of at least 1.8 m. */
export interface CityParametersFurnitureBenches {
  /** The distance between positions along one side of a street. */
  spacing?: number;
  /** The share of the positions that are used. A random number for each position decides. */
  share?: number;
  /** Requests among which each position chooses. Empty: a built-in model. */
  models?: Child[];
}

/** Bins on sidewalks of at least 1.2 m. */
export interface CityParametersFurnitureBins {
  /** The distance between positions along one side of a street. */
  spacing?: number;
  /** The share of the positions that are used. A random number for each position decides. */
  share?: number;
  /** Requests among which each position chooses. Empty: a built-in model. */
  models?: Child[];
}

/** Signs at the right side of streets that lead to junctions. */
export interface CityParametersFurnitureSigns {
  /** The share of these positions that are used. */
  share?: number;
  /** Requests among which each position chooses. Empty: a built-in model. */
  models?: Child[];
}

/** Cars beside the kerbs of carriageways of at least 6 m. */
export interface CityParametersFurnitureCars {
  /** The distance between positions along one side of a street. */
  spacing?: number;
  /** The share of the positions that are used. A random number for each position decides. */
  share?: number;
  /** Requests among which each position chooses. Empty: a built-in model. */
  models?: Child[];
}

/** Objects along the streets, as copies of shared models. Kinds that are not given are left out. */
export interface CityParametersFurniture {
  /** Street lamps at the kerbs, on both sides in turn. */
  lamps?: CityParametersFurnitureLamps;
  /** Trees along kerbs with sidewalks of at least 1.5 m, at least 8 m away from junctions. */
  trees?: CityParametersFurnitureTrees;
  /** Benches on sidewalks of at least 1.8 m. */
  benches?: CityParametersFurnitureBenches;
  /** Bins on sidewalks of at least 1.2 m. */
  bins?: CityParametersFurnitureBins;
  /** Signs at the right side of streets that lead to junctions. */
  signs?: CityParametersFurnitureSigns;
  /** Cars beside the kerbs of carriageways of at least 6 m. */
  cars?: CityParametersFurnitureCars;
}

/** Trees of the parks. Without this object, parks are lawns. */
export interface CityParametersParks {
  /** The mean distance between trees. */
  spacing?: number;
  /** Requests of trees, such as those of the generators tree and lsystem. Empty: built-in trees. */
  models?: Child[];
}

/** Trees, hedges and fences of lots with buildings. Without this object, yards are lawns. */
export interface CityParametersYards {
  /** The mean number of trees of a lot of 600 m²; other lots have trees by their area. Trees keep away from buildings and borders. */
  trees?: number;
  /** Requests of trees. Empty: built-in trees. */
  models?: Child[];
  /** What stands along the borders between lots, outside of the buildings. */
  border?: "none" | "hedge" | "fence" | "wall";
  /** Whether the border also closes the lot against streets. It stands on both sides of the building and, behind that line, along the other streets of the lot. */
  front?: boolean;
  /** The height of hedges, fences and walls. */
  height?: number;
}

/** Divides the model into parts with nodes of their own, so that engines can skip parts out of view. */
export interface CityParametersChunks {
  /** blocks: a part for each block, with the streets in parts of their own. squares: a part for each square of the given size. */
  by?: "blocks" | "squares";
  /** The length of a side. */
  size?: number;
}

/** The point of view. Each building and each copy gets the level of detail that fits its size on the screen. */
export interface CityParametersCamera {
  /** East, north, and above height 0. */
  position: [number, number, number];
  /** The angle from the lower to the upper edge of the screen. */
  field_of_view?: number;
}

/** A city as an exact partition of its area. Streets grow by an extended L-system after Parish and Müller (2001). The faces of their graph become blocks, and blocks are divided into lots with street access. Each lot has a building, which is a whole request of its own. */
export interface CityParameters {
  /** The area that is partitioned. */
  area?: CityParametersArea;
  /** The natural ground: a request of the generator terrain (a plane), with its centre at the origin. Beyond its border the ground has the height of the border. Default: level ground at height 0. */
  terrain?: Child;
  /** Quantities that vary over the area. */
  maps?: CityParametersMaps;
  /** Existing parts of the city as GeoJSON in local metres. They stay as they are, and the rest grows from them. */
  given?: CityParametersGiven;
  /** The growth of the streets. */
  streets?: CityParametersStreets;
  /** The division of the blocks. */
  lots?: CityParametersLots;
  /** The buildings of the lots. */
  buildings?: CityParametersBuildings;
  /** Materials of the ground and of walls, in place of the usual ones. */
  surfaces?: CityParametersSurfacesItem[];
  /** Objects along the streets, as copies of shared models. Kinds that are not given are left out. */
  furniture?: CityParametersFurniture;
  /** Trees of the parks. Without this object, parks are lawns. */
  parks?: CityParametersParks;
  /** Trees, hedges and fences of lots with buildings. Without this object, yards are lawns. */
  yards?: CityParametersYards;
  /** Divides the model into parts with nodes of their own, so that engines can skip parts out of view. */
  chunks?: CityParametersChunks;
  /** The point of view. Each building and each copy gets the level of detail that fits its size on the screen. */
  camera?: CityParametersCamera;
}

/** Map */
export interface FractalParametersInstructions2Item {
  /** One factor, or three for X, Y and Z. Negative factors mirror. */
  scale?: number | [number, number, number];
  /** Rotations about X, then Y, then Z, applied after the scale. */
  rotate?: [number, number, number];
  /** Translation after scale and rotation, in edges of the unit element. */
  translate?: [number, number, number];
  /** Replaces the three members above: three rows of four numbers, of which the last is the translation. */
  matrix?: number[];
  /** Weight with which frcm chooses this map. If left out, it is the volume of the copy, or its area if it is flat, and at least a hundredth of the sum. */
  probability?: number;
}

/** A model */
export interface FractalParametersElement2 {
  model?: Child;
  /** A mesh as data:model/gltf-binary;base64,… . Its textures are not used. */
  glb?: string;
}

/** Window and iteration of the escape-time relief. The defaults show the whole Mandelbrot set. */
export interface FractalParametersEscape {
  /** mandelbrot: c is the point, and z starts at 0. julia: z starts at the point, and c is the constant. */
  set?: "mandelbrot" | "julia";
  /** Centre of the window in the complex plane: real and imaginary part. */
  center?: [number, number];
  /** Width of the window. */
  span?: number;
  /** The constant c of a Julia set. */
  constant?: [number, number];
  /** Number of steps after which a point counts as one that never leaves. */
  limit?: number;
  /** Number of samples along a side. */
  resolution?: number;
  /** Height of the set above the plate, in edges of the plate. */
  relief?: number;
  /** Thickness below the relief, in edges of the plate. */
  plate?: number;
}

/** Iterated function systems and escape-time fractals. mrcm copies an element with every map, round after round. frcm is the chaos game: one point, moved by randomly chosen maps. escape shows as a relief how soon points leave under z² + c. Maps act in the frame of a unit element centred at the origin, X to the right, Y up. */
export interface FractalParameters {
  /** mrcm: multiple reduction copy machine, which applies all maps in every round. frcm: fortune wheel reduction copy machine (chaos game), which gives a cloud of points. escape: the relief of a Mandelbrot or Julia set. */
  method?: "mrcm" | "frcm" | "escape";
  /** A named set of maps, or a list of maps. The attractor depends only on these. */
  instructions?: "menger_sponge" | "koch_cube" | "corner_cube" | "corner_cube_centre" | "corner_cube_outside" | "corner_cube_two_thirds" | "sierpinski_pyramid" | "sierpinski_triangle" | "word_test" | "sierpinski_tetrahedron" | "sierpinski_carpet" | "cantor_dust" | "vicsek" | "mosely_snowflake" | "jerusalem_cube" | "pascal_parity" | "dragon" | "tree" | "fern" | "koch_curve" | "koch_snowflake" | FractalParametersInstructions2Item[];
  /** The element that is copied. letter_plate is marked with a letter that shows how copies are rotated. segment is a line along X. plate is the area inside the Koch snowflake. A model is fitted into the unit cube. */
  element?: "cube" | "pyramid" | "rainbow_cube" | "sphere" | "tetrahedron" | "letter_plate" | "segment" | "plate" | FractalParametersElement2;
  /** Number of rounds of copying. */
  iterations?: number;
  /** Several states side by side, from left to right: numbers of rounds (mrcm) or of points (frcm). If empty, there is one state. */
  stages?: number[];
  /** Number of stages in a row. The next row is below it. */
  columns?: number;
  /** The word that word_test writes: letters, digits and spaces. */
  text?: string;
  /** A copy whose frame is smaller than this becomes a point and is not copied again. 0: all copies stay elements. */
  smallest?: number;
  /** The surface if the maps fill cells of a lattice with cubes. faces: a square for each visible side of a cell. merged: the same surface with squares joined into rectangles. pieces: every copy complete. Other maps always give pieces. */
  surface?: "faces" | "merged" | "pieces";
  /** Length of the edge of the unit element. */
  size?: number;
  color?: string;
  specular?: Specular;
  emission?: Emission;
  /** Colours of the maps (frcm), repeated if there are more maps. For escape, colours from early to late escape. */
  palette?: string[];
  /** normalize: probabilities of maps that do not sum to 1 count as shares of their sum, with a warning. strict: they are an error. */
  weights?: "normalize" | "strict";
  /** Number of points. */
  points?: number;
  /** Where the first point lies: at random on the surface of the element, or on its line; or at random in the unit cube. */
  start?: "element" | "cube";
  /** Number of points at the start of each chain that are left out, because they are not yet near the attractor. */
  drop?: number;
  /** points: points with the colour of their last map. elements: a small element at every point. voxels: the surface of all cells that contain a point. */
  cloud?: "points" | "elements" | "voxels";
  /** Number of cells along the longest side of the cloud. An element has the size of a cell. */
  voxels?: number;
  /** Window and iteration of the escape-time relief. The defaults show the whole Mandelbrot set. */
  escape?: FractalParametersEscape;
}

/** One set of productions. */
export interface LsystemParametersTablesItem {
  /** The number of steps for which it is active. */
  steps?: number;
  /** Rules as above. */
  productions: string[];
}

/** The allowed symbols. If it is given, any other symbol is an error at its column, which finds misspelt modules. */
export interface LsystemParametersAlphabet {
  /** Symbols that productions can rewrite. */
  variables: string;
  /** Symbols that productions cannot rewrite. */
  constants?: string;
}

export interface LsystemParametersAngle2 {
  /** The turn of + and -. */
  yaw?: number;
  /** The turn of & and ^. */
  pitch?: number;
  /** The turn of \ and /. */
  roll?: number;
  /** Every turn deviates at random by up to this value to either side. */
  spread?: number;
}

export interface LsystemParametersStep2 {
  /** The mean length. */
  value?: number;
  /** Every step deviates at random by up to this value to either side; it never falls below 0. */
  spread?: number;
}

export interface LsystemParametersWidth2 {
  /** The mean diameter. */
  value?: number;
  /** Every width deviates at random by up to this value to either side; it never falls below 0. */
  spread?: number;
}

/** One force. */
export interface LsystemParametersTropismItem {
  /** The direction of the force as x, y, z: [0,-1,0] is gravity, [0,1,0] light from above. The length of the vector is the strength. */
  direction: [number, number, number];
  /** How strongly branches bend without a @Ts; negative values turn away. */
  elasticity?: number;
  /** The value that one @T adds to the elasticity and one @Td subtracts. */
  step?: number;
}

/** One closed shape. */
export interface LsystemParametersEnvironmentSolidsItem {
  /** The effect of the solid: growth stays inside the union of all guides, outside every obstacle, and outside every host, which is also drawn. */
  role?: "guide" | "obstacle" | "host";
  /** A shape that fills its size, or mesh: a model of its own. */
  shape: "box" | "sphere" | "cylinder" | "cone" | "mesh";
  /** The middle of the lower face of the box around the shape; for a mesh, the position of its origin. */
  position?: [number, number, number];
  /** Width, height and depth of the shape; for a mesh, its scale. */
  size?: [number, number, number];
  model?: Child;
  /** The mesh as a GLB file in a data URI, instead of a model. */
  glb?: string;
}

/** The shadows of limbs: cells of this size, each of which removes light from a pyramid of cells below it. */
export interface LsystemParametersEnvironmentLight {
  /** The width of a cell. */
  cell?: number;
  /** The share of the light that a filled cell removes from the cell directly below it. */
  shade?: number;
  /** The divisor of the shade from layer to layer. */
  falloff?: number;
  /** The depth of a shadow in layers of cells. */
  layers?: number;
}

/** One L-system and its position. */
export interface LsystemParametersEnvironmentCompanionsItem {
  /** The start of its turtle. */
  position?: [number, number, number];
  system: Child;
}

/** The surroundings of the plant: solids that bound it or stand in its way, light, and other L-systems that grow beside it step by step. Modules ?E query it. Limbs in forbidden space are cut away. */
export interface LsystemParametersEnvironment {
  /** Guides, which growth cannot leave; obstacles, which it cannot enter; and hosts, which are obstacles that are part of the model. */
  solids?: LsystemParametersEnvironmentSolidsItem[];
  /** When a segment counts as outside. centre: its centre is outside. whole: any part of it is outside. clipped: it is cut at the surface. */
  membership?: "centre" | "whole" | "clipped";
  /** A step is free only if its distance from other limbs exceeds both radii and this value. */
  clearance?: number;
  /** The shadows of limbs: cells of this size, each of which removes light from a pyramid of cells below it. */
  light?: LsystemParametersEnvironmentLight;
  /** Other L-systems that grow in the same environment, step by step with this one. */
  companions?: LsystemParametersEnvironmentCompanionsItem[];
}

/** Bends the finished plant: each limb turns because of the force on it and on everything beyond it, less if it is thicker, from the root to the tips. */
export interface LsystemParametersWeather {
  /** Speed of the air. 5 moves leaves, 10 twigs, 20 bends trees. */
  wind?: number;
  /** The direction that the wind blows to: 0 is +X, 90 is -Z. */
  direction?: number;
  /** Water on bark and leaves as a film of this thickness: 0.2 is a wet leaf. */
  rain?: number;
  /** Mass of the snow on each square metre, seen from above. */
  snow?: number;
  /** Young's modulus of the wood: green wood has 5 to 15, herbs have less than 1. */
  stiffness?: number;
}

/** One organ. */
export interface LsystemParametersSurfacesValue {
  /** A leaf or petal of this outline, a fruit, patches, a model of its own, or a sphere or disc with its centre at the turtle. A disc lies in the plane of heading and left. */
  shape?: "simple" | "willow" | "birch" | "cordate" | "lobed" | "maple" | "ginkgo" | "compound" | "palmate" | "needles" | "pine_needles" | "palm" | "kite" | "petal" | "fruit" | "patches" | "model" | "sphere" | "disc";
  /** The geometry of a leaf: mesh is its outline. Squares with a texture of the leaf are card (one), cross (two) and curved (a bent one). Squares with a texture of a twig are twig (a bent one) and bunch (three bent ones). */
  build?: "mesh" | "card" | "cross" | "curved" | "twig" | "bunch";
  /** Length from base to tip; the diameter of spheres and discs; for patches and models, the scale of their coordinates. */
  size?: number;
  /** The factor of the width. */
  width?: number;
  /** The angle by which both halves of a leaf are raised about its midrib. */
  fold?: number;
  /** The angle by which a leaf bends down from base to tip. */
  droop?: number;
  /** How far the end of a fruit is elongated. */
  pointed?: number;
  /** The colour index in materials; -1 uses the turtle's. Without `materials`, a leaf, petal or fruit in the turtle's first colour has the colour of its kind instead of that of bark. */
  color?: number;
  /** Whether a leaf gets the texture of its own shape if its material has none: auto: only if the leaf is made of squares. */
  picture?: "auto" | "own" | "none";
  model?: Child;
  /** A mesh as data:model/gltf-binary;base64,… , with +Y along the heading and +Z up. Its textures are left out. */
  glb?: string;
  /** Bicubic patches of 4 by 4 control points, row by row, each [x, y, z] with y along the heading and z up. */
  patches?: (([number, number, number])[])[];
  /** The basis of patches: Bézier patches pass through the corner points, uniform B-splines lie inside and join their neighbours smoothly. */
  basis?: "bezier" | "b_spline";
  /** Squares along each side of a patch. */
  divisions?: number;
}

export type Texture = "none" | "oak_bark" | "pine_bark" | "spruce_bark" | "willow_bark" | "birch_bark" | "beech_bark" | "cherry_bark" | "palm_bark" | "cedar_bark" | "simple_leaf" | "willow_leaf" | "birch_leaf" | "cordate_leaf" | "lobed_leaf" | "maple_leaf" | "ginkgo_leaf" | "compound_leaf" | "palmate_leaf" | "needles" | "pine_needles" | "palm_leaf" | "kite_leaf" | "petal" | "simple_twig" | "willow_twig" | "birch_twig" | "cordate_twig" | "lobed_twig" | "maple_twig" | "ginkgo_twig" | "needles_twig" | "pine_needles_twig" | "petal_twig";

/** One material. */
export interface LsystemParametersMaterialsItem {
  /** The material's name in the file. */
  name?: string;
  /** A colour in sRGB, as #rrggbb. For a texture it is the main colour; without it the texture has its own. Images are multiplied by it. */
  color?: string;
  /** 0 is a mirror, 1 is chalk. */
  roughness?: number;
  /** 0 is bark, stone or plastic; 1 is bare metal. */
  metallic?: number;
  /** Values below 1 are transparent, as for the leaves of Kogovšek's trees. */
  opacity?: number;
  emission?: Emission;
  specular?: Specular;
  texture?: Texture;
  /** Another seed gives another texture of the same kind. Models with the same texture, seed and colour share it. */
  texture_seed?: number;
  images?: Images;
}

/** A parallel rewriting grammar after Lindenmayer, drawn by a turtle as in Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants: plants, space-filling curves and other fractals that branch. */
export interface LsystemParameters {
  /** The modules that the derivation starts from. */
  axiom: string;
  /** Rules of the form lc < predecessor > rc : condition -> successor : probability. Only predecessor, arrow and successor are required. Productions with a context are tried before those without; within each group the order of this list counts. An empty successor, or only *, erases the module. */
  productions?: string[];
  /** The number of times that every module is rewritten. 0 draws the axiom. The size of the model grows quickly with it, mostly exponentially. */
  iterations?: number;
  /** The age of the plant in iterations, fractions included. If the last iteration is incomplete, what it writes has only that fraction of its length and turn. Default: all iterations. */
  age?: number;
  /** Productions, interpretation and constants can use the name age for the age of the plant, and all iterations are derived. A module stores the time of its birth, and its growth function is explicit, as in F(t) -> F(min(1, age - t)). */
  timed?: boolean;
  /** Names with a value that productions and the axiom can use: a number, or an expression over other constants. */
  constants?: { [key: string]: number | string };
  /** Names with a value that statements can change: a number, or an expression over constants and other variables. All productions share them. */
  variables?: { [key: string]: number | string };
  /** Lists of numbers by name: list[0] is the first one. Statements can change them. All arrays together have at most 10,000 elements. */
  arrays?: { [key: string]: number[] };
  /** Statements that run before each derivation step, such as `n = n + 1;`. They can change variables and arrays. */
  start_each?: string;
  /** Statements that run after each derivation step. They can change variables and arrays. */
  end_each?: string;
  /** contexts_first: productions with a context are tried before those without. listed: all are tried in the order of the list, as in cpfg. */
  rule_order?: "contexts_first" | "listed";
  /** normalize: probabilities that do not sum to 1 count as shares of their sum, with a warning. strict: they are an error. */
  weights?: "normalize" | "strict";
  /** A predecessor can have several modules. They must follow each other in the word, and are replaced together. */
  strict_predecessors?: boolean;
  /** Symbols that the search for left and right contexts skips, usually the turtle's turns. */
  ignore?: string;
  /** The only symbols that the search for contexts considers; all others are skipped. It replaces ignore. */
  consider?: string;
  /** The word is a ring: its last module is the left neighbour of its first. */
  ring?: boolean;
  /** Productions that split modules in the step that wrote them, and in the axiom. Unlike interpretation rules they change the word. */
  decomposition?: string[];
  /** How many times the decomposition rules apply to their own results within a step. */
  decomposition_depth?: number;
  /** Sets of productions that take turns. Each set is active for its number of steps. Then the next set follows, and after the last one the first again. The productions above are active in every step, after those of the table. */
  tables?: LsystemParametersTablesItem[];
  /** Functions that expressions can use, as name(parameter, ...) = expression. They can use constants and each other, but not themselves. */
  functions?: string[];
  /** Names of more than one character, each of which is one module. If parameters are given in parentheses, their number is checked; a parameter that begins with the word frame is a local coordinate system. */
  modules?: string[];
  /** The allowed symbols. If it is given, any other symbol is an error at its column, which finds misspelt modules. */
  alphabet?: LsystemParametersAlphabet;
  /** Productions that apply only while drawing: they give symbols of the grammar a shape without changing the derivation. */
  interpretation?: string[];
  /** How many times the interpretation rules apply to their own results. */
  interpretation_depth?: number;
  /** The turn of + - & ^ \ / without an argument: one angle for all, or one for each axis. */
  angle?: number | LsystemParametersAngle2;
  /** The length of an F or f without an argument. */
  step?: number | LsystemParametersStep2;
  /** The diameter that the turtle starts with. */
  width?: number | LsystemParametersWidth2;
  /** The rule for the diameter of a segment. symbols: ! and its argument. decrement: thinner by the width decrement for each derivation step before the segment appeared. branch_factor: multiplied by the width factor for each bracket around the segment. longest_chain: increases linearly with the number of segments to the farthest tip. Every tip has the tip width, and the longest chain of the plant begins with the turtle's first width. pipe_model: the tip width at every tip; where limbs meet, powers of their diameters are added (pipe_exponent). */
  width_rule?: "symbols" | "decrement" | "branch_factor" | "longest_chain" | "pipe_model";
  /** The value that a ! without an argument subtracts from the diameter, and that the width rule decrement subtracts for each derivation step. */
  width_decrement?: number;
  /** The factor of the diameter for each bracket, for the width rule branch_factor. */
  width_factor?: number;
  /** The diameter at the end of every chain of segments, for the width rules longest_chain and pipe_model. */
  tip_width?: number;
  /** The power of the diameter that is summed where limbs meet, for the width rule pipe_model: 2 sums cross-sections, as Leonardo observed; real trees have 1.8 to 3. */
  pipe_exponent?: number;
  /** Forces that turn growing segments. After each segment, the heading turns toward the direction by elasticity times the sine of the angle between the two, in radians. This is the formula of The Algorithmic Beauty of Plants, section 2.1.4. Several can act; @Ts, @T and @Td change the elasticity of a branch. */
  tropism?: LsystemParametersTropismItem[];
  /** The surroundings of the plant: solids that bound it or stand in its way, light, and other L-systems that grow beside it step by step. Modules ?E query it. Limbs in forbidden space are cut away. */
  environment?: LsystemParametersEnvironment;
  /** Bends the finished plant: each limb turns because of the force on it and on everything beyond it, less if it is thicker, from the root to the tips. */
  weather?: LsystemParametersWeather;
  /** Organs by name: ~leaf places the surface leaf, ~leaf(2) twice as large. Its base is at the turtle's position, its tip points along the heading, and its upper side points up. */
  surfaces?: { [key: string]: LsystemParametersSurfacesValue };
  /** Cross-sections that @# selects, counted from 1: closed outlines of [x, y] for a radius of 1, x to the turtle's right and y to its up, in either orientation. Every point lies within the unit circle and is visible from (0, 0). Tubes have at least as many sides as the longest contour has points. */
  contours?: (([number, number])[])[];
  /** How far the normals of organs follow those of a ball around all organs, so that a crown is lit as one body; 0 does not change them. */
  crown_normals?: number;
  /** The geometry of segments: tubes with a diameter, or lines without one. */
  style?: "tubes" | "lines";
  /** The number of sides of a tube around its axis. */
  sides?: number;
  /** The number of rings of faces of a segment along its axis if its width changes. A segment with constant width has one, unless the parameter levels is slices. */
  stacks?: number;
  /** How the diameter changes between segments. linear: along each segment, from the diameter of the one before it to its own. none: each segment is a cylinder of its own diameter, as gluCylinder draws it with two equal radii. A new tube begins where the diameter changes. */
  taper?: "linear" | "none";
  /** Whether parts of a self-similar system that occur again are one mesh with copies. auto: where the whole drawing would have more than 64 million modules or 40 million triangles or lines. Parts with random choices, parameters or polygons are never shared. */
  share?: "auto" | "always" | "never";
  /** How the tubes of coarser levels of detail (`output.lods`) save triangles. outline: fewer limbs and joints, those that change the outline least. slices: all limbs, with the sides and stacks of level 0 divided by the root of the level plus 1: 32 sides become 22, 18, 16 and 14. */
  levels?: "outline" | "slices";
  /** Whether thinner limbs have fewer sides and shorter segments fewer stacks. Coarser levels of detail always do. */
  adapt?: boolean;
  /** Joins the limbs that brackets begin into one surface, as for trees: limbs of similar thickness in a fork, thin limbs in a collar. Limbs where no joint fits, and limbs with a contour, stay closed tubes that begin inside their parent. Thin welded limbs have fewer sides, and rings where they bend; stacks and adapt have no effect on them. */
  weld?: boolean;
  /** The materials that the turtle's colour index selects, counted from 0. An empty list gives a built-in palette that starts with bark and leaf. */
  materials?: LsystemParametersMaterialsItem[];
}

/** The level ground if there is no terrain. */
export interface SceneParametersGround {
  /** The length of a side, or the diameter of a disc. */
  size?: number;
  /** The outline: square, disc, or none for no ground. */
  outline?: "square" | "disc" | "none";
  color?: string;
  specular?: Specular;
  emission?: Emission;
}

/** Path */
export interface SceneParametersPathsItem {
  /** East and south of the middle. */
  points: ([number, number])[];
  /** The width of the path. */
  width?: number;
  /** Whether the path is drawn. Otherwise it only keeps models away. */
  shown?: boolean;
  color?: string;
  specular?: Specular;
  emission?: Emission;
}

/** Area */
export interface SceneParametersAreasItem {
  /** Areas of one name and colour are one mesh with this name. */
  name?: string;
  /** The outer ring, then holes, in any direction. */
  outline: (([number, number])[])[];
  color?: string;
  specular?: Specular;
  emission?: Emission;
  /** 0 reflects like still water, 1 is matt. */
  roughness?: number;
}

/** The roof above the walls. */
export interface SceneParametersBuildingsItemRoof {
  /** flat, skillion (one slope), gabled, half_hipped, gambrel, saltbox (the ridge at 0.35 of the width), round, hipped, mansard, pyramidal, dome or onion. */
  shape?: "flat" | "skillion" | "gabled" | "half_hipped" | "gambrel" | "saltbox" | "round" | "hipped" | "mansard" | "pyramidal" | "dome" | "onion";
  /** The height from the top of the walls to the highest point. Default: by `angle`, or else by the shape, at most half of the height of the building. */
  height?: number;
  /** The slope, instead of the height. */
  angle?: number;
  /** The direction down the slope, clockwise from north; the ridge is across. Default: by the shape of the footprint. */
  direction?: number;
  /** The direction of the ridge if there is no `direction`: along the longer side of the footprint, or across it. */
  orientation?: "along" | "across";
  color?: string;
}

/** Building */
export interface SceneParametersBuildingsItem {
  /** The name of the node. Default: building and its number. */
  name?: string;
  /** The outer ring, then courtyards, in any direction, with or without the first point at the end. */
  footprint: (([number, number])[])[];
  /** The height of the floor above the ground, for parts of buildings that begin higher. */
  base?: number;
  /** The height of the highest point above the ground, with the roof. */
  height?: number;
  color?: string;
  /** The surface of the walls and the roof: how rough it is, and whether it is a metal. */
  material?: "plain" | "glass" | "metal";
  /** The roof above the walls. */
  roof?: SceneParametersBuildingsItemRoof;
}

/** The geographic position of the origin, and the projection of all positions. The file repeats it as `asset.extras.georeference`. */
export interface SceneParametersGeoreference {
  /** North of the equator, WGS 84. */
  latitude: number;
  /** East of Greenwich, WGS 84. */
  longitude: number;
  /** The projection as PROJ writes it. */
  projection?: string;
}

/** Variation */
export interface SceneParametersLayersItemVaryItem {
  /** Name of a parameter of the model; dots separate the names of members, as in constants.r. */
  parameter: string;
  /** The smallest value, an integer if the parameter is one. */
  from?: number;
  /** The largest value. */
  to?: number;
  /** Values to choose from, instead of a range. */
  among?: (number | string | boolean)[];
}

/** Position */
export interface SceneParametersLayersItemPlacePositionsItem {
  /** East and south of the middle. */
  at: [number, number];
  /** About the vertical axis, counter-clockwise seen from above. Default: the value of the layer. */
  turn?: number;
  /** Default: the value of the layer. */
  scale?: number;
  /** The age of this plant, for its parameter `age`. */
  age?: number;
  /** The model at this position instead of the model of the layer. */
  model?: Child;
}

/** The groups (clusters). Most of a group lies within twice its radius. */
export interface SceneParametersLayersItemPlaceClusters {
  /** The number of groups. */
  count: number;
  /** Standard deviation of the distance from the centre of the group, in each direction. */
  radius: number;
}

/** Patches by smooth noise. */
export interface SceneParametersLayersItemPlaceNoise {
  /** The typical distance from patch to patch. */
  wavelength?: number;
  /** The approximate share of the ground that the patches cover. */
  share?: number;
  /** The softness of the edges of patches: 0 is hard. */
  soft?: number;
}

/** Limits of the slope of the ground; level ground has 0. */
export interface SceneParametersLayersItemPlaceSlope {
  /** No position below this value. */
  from?: number;
  /** No position above this value. */
  to?: number;
  /** The width inside the limits over which the probability rises from 0 to 1. */
  soft?: number;
}

/** Limits of the height of the ground. */
export interface SceneParametersLayersItemPlaceAltitude {
  /** No position below this value. */
  from?: number;
  /** No position above this value. */
  to?: number;
  /** The width inside the limits over which the probability rises from 0 to 1. */
  soft?: number;
}

/** Limits of the height above the water of the terrain; negative values are under water. Default: no position under water. */
export interface SceneParametersLayersItemPlaceAboveWater {
  /** No position below this value. */
  from?: number;
  /** No position above this value. */
  to?: number;
  /** The width inside the limits over which the probability rises from 0 to 1. */
  soft?: number;
}

/** Limits of the shade of the crowns of earlier layers: 0 is open, 1 full shade. */
export interface SceneParametersLayersItemPlaceShade {
  /** No position below this value. */
  from?: number;
  /** No position above this value. */
  to?: number;
  /** The width inside the limits over which the probability rises from 0 to 1. */
  soft?: number;
}

/** Neighbour */
export interface SceneParametersLayersItemPlaceNearItem {
  /** Name of an earlier layer. */
  layer: string;
  /** No position nearer than this. */
  from?: number;
  /** No position farther away than this. */
  to?: number;
}

/** The positions of the layer. */
export interface SceneParametersLayersItemPlace {
  /** poisson: everywhere, with a least distance of `distance`. scatter: `count` random positions. clusters: `count` positions in groups. rows: on a grid of `spacing`. path: along `points`. positions: the list `positions`. The description of each other member of `place` ends with the methods that use it, in parentheses. */
  method?: "poisson" | "scatter" | "clusters" | "rows" | "path" | "positions";
  /** Explicit positions (positions). */
  positions?: SceneParametersLayersItemPlacePositionsItem[];
  /** The number of positions (scatter, clusters), or the largest number (poisson, rows, path). */
  count?: number;
  /** The least distance between two positions (poisson), or the distance from one to the next (path). */
  distance?: number;
  /** The distance from one to the next in a row, and from row to row (rows). */
  spacing?: [number, number];
  /** The angle of the rows from east, counter-clockwise seen from above (rows). */
  angle?: number;
  /** Every second row is moved along by this share of the spacing (rows). */
  stagger?: number;
  /** Each position is moved at random by at most this distance (rows, path). */
  jitter?: number;
  /** The path: east and south of the middle (path). */
  points?: ([number, number])[];
  /** The distance from the path (path). */
  offset?: number;
  /** The side of the path, seen along it (path). */
  side?: "both" | "left" | "right";
  /** The groups (clusters). Most of a group lies within twice its radius. */
  clusters?: SceneParametersLayersItemPlaceClusters;
  /** A polygon that contains all positions. Default: the whole ground. */
  area?: ([number, number])[];
  /** The least distance from the edge of the ground. */
  edge?: number;
  /** The share of positions that is kept. */
  density?: number;
  /** A PNG as a data URI that covers the ground, north at its top: black removes all positions, white keeps all. */
  density_image?: string;
  /** Patches by smooth noise. */
  noise?: SceneParametersLayersItemPlaceNoise;
  /** Classes of the ground of the terrain. The probability of a position is 0 where these classes cover at most 30 % of the ground. It rises to 1 where they cover 55 %. Default: all classes. */
  ground?: ("grass" | "soil" | "rock" | "scree" | "sand" | "snow" | "litter")[];
  /** Limits of the slope of the ground; level ground has 0. */
  slope?: SceneParametersLayersItemPlaceSlope;
  /** Limits of the height of the ground. */
  altitude?: SceneParametersLayersItemPlaceAltitude;
  /** Limits of the height above the water of the terrain; negative values are under water. Default: no position under water. */
  above_water?: SceneParametersLayersItemPlaceAboveWater;
  /** Limits of the shade of the crowns of earlier layers: 0 is open, 1 full shade. */
  shade?: SceneParametersLayersItemPlaceShade;
  /** Limits of the distance to the nearest model of another layer. */
  near?: SceneParametersLayersItemPlaceNearItem[];
}

/** The ground under the footprint is made level. */
export interface SceneParametersLayersItemFoundation {
  /** The width around the foundation over which the level ground changes to the terrain. */
  slope_width?: number;
}

/** Layer */
export interface SceneParametersLayersItem {
  /** The name of the layer in the response and for other layers. With a name, random choices do not depend on the number of the layer. */
  name?: string;
  /** The model: a request of any generator except scene. */
  model: Child;
  /** The number of different models, each of another seed. Each is made once and used at many positions. */
  variants?: number;
  /** Parameters of the model that get a random value for each variant. */
  vary?: SceneParametersLayersItemVaryItem[];
  /** The age of the plants, for the parameter `age` of their generator; drawn for each variant. */
  age?: number | [number, number];
  /** The time at which a plant begins to grow in the growth animation, drawn for each position. The duration of its growth does not change. Default: at once. */
  start?: number | [number, number];
  /** The positions of the layer. */
  place?: SceneParametersLayersItemPlace;
  /** Size relative to the model. */
  scale?: number | [number, number];
  /** Rotation about the vertical axis. */
  turn?: number | [number, number];
  /** The largest random angle between the model and its usual direction. */
  tilt?: number;
  /** 1 is vertical, 0 is perpendicular to the ground. */
  upright?: number;
  /** The depth of the model's origin below the ground. */
  sink?: number;
  /** Radius of the crown at scale 1, for competition and shade. */
  crown?: number;
  /** The area on the ground at scale 1, as a radius, or as width (east) and depth (south) before rotation. Later layers and other copies of this layer keep out of it. */
  footprint?: number | [number, number];
  /** The ground under the footprint is made level. */
  foundation?: SceneParametersLayersItemFoundation;
}

/** The point of view. Each copy gets the level of detail that fits its size on the screen, and small plants become impostors. */
export interface SceneParametersCamera {
  /** East of the middle of the ground, above height 0, and south. */
  position: [number, number, number];
  /** The angle from the lower to the upper edge of the screen. */
  field_of_view?: number;
  /** Whether plants with less than 6 % of the screen's height become impostors of 12 triangles. Never if `output.textures` is none. */
  impostors?: boolean;
}

/** Many models on one ground. Each layer is a request and a rule for the positions of its copies. Each model is made once, and all its copies share it. Layers are placed in their order. */
export interface SceneParameters {
  /** The ground: a request of the generator terrain (a plane). Default: level ground. */
  terrain?: Child;
  /** The level ground if there is no terrain. */
  ground?: SceneParametersGround;
  /** Paths, on which layers place nothing. */
  paths?: SceneParametersPathsItem[];
  /** Coloured areas on level ground, such as water, grass and squares. Areas of one name and colour lie at one height, above the areas before them in the list. */
  areas?: SceneParametersAreasItem[];
  /** Buildings as bodies with a roof, such as those of a map. Each is one closed mesh. If there are at most 2,000, each has a node of its own; otherwise they are merged. Layers keep away from them. */
  buildings?: SceneParametersBuildingsItem[];
  /** The geographic position of the origin, and the projection of all positions. The file repeats it as `asset.extras.georeference`. */
  georeference?: SceneParametersGeoreference;
  /** The layers of models. */
  layers?: SceneParametersLayersItem[];
  /** The age of all plants, for the parameter `age` of generators that have it. A plant that would be younger keeps its own age. */
  age?: number;
  /** The season of all plants whose generator has a parameter `season`. */
  season?: "spring" | "summer" | "autumn" | "winter";
  /** The least distance of crowns as a share of the sum of their radii. Of two crowns that are nearer, the smaller one is removed. 0: none is removed. */
  competition?: number;
  /** The point of view. Each copy gets the level of detail that fits its size on the screen, and small plants become impostors. */
  camera?: SceneParametersCamera;
  /** The copies of a model are divided into this number of groups by area, from west to east and from north to south. Engines can then skip groups out of view. */
  chunks?: number;
  /** Whether the response of derive has the word of each model that is an L-system, with its depth and its numbers of modules and branches. The shapes of the scene stay the same. */
  words?: boolean;
}

/** One layer. */
export interface TerrainParametersLayersItem {
  /** A name by which expressions of later layers use the heights of this one. */
  name?: string;
  /** Where the heights of the layer come from. */
  algorithm?: "expression" | "fault_formation" | "poisson_faulting" | "fbm" | "triangular_edge" | "diamond_square" | "square_square";
  /** As that of the terrain. It can also use height and slope, the height in metres and the slope in degrees so far, and the names of earlier layers. A sphere has no slope. */
  expression?: string;
  /** The operation on the height so far and that of the layer. replace takes the layer. none only gives it a name. */
  combine?: "add" | "subtract" | "multiply" | "max" | "min" | "replace" | "none";
  /** Where the layer has an effect: an expression from 0 (nowhere) to 1, with the same names, such as slope < 30, or height / 100. */
  mask?: string;
  /** The number of faults, the octaves of noise, or the rounds of subdivision, which begins with squares of 2^iterations cells. Default: 64 faults, 8 octaves, or the rounds whose first square covers the terrain. */
  iterations?: number;
  /** As that of the terrain, for fbm and subdivisions. */
  amplitude?: number;
  /** As that of the terrain, for fbm and subdivisions. */
  hurst?: number;
  /** As that of the terrain, for fbm. */
  noise?: "rolling" | "ridged" | "billow";
  /** As that of the terrain, for fbm. */
  wavelength?: number;
  /** As that of the terrain, for faults. */
  fault_max?: number;
  /** As that of the terrain, for faults. */
  fault_min?: number;
}

/** For fracture: the body that breaks, where it breaks, and its layers. */
export interface TerrainParametersFracture {
  /** Half axes of the body along X, Y and Z, as shares of half the size. */
  axes?: [number, number, number];
  /** Least and greatest distance of a plane from the centre, as shares of the distance at which it touches the body. */
  depth?: [number, number];
  /** Width over which edges are worn, as a share of half the size. */
  bevel?: number;
  /** How far the softest layers recede, as a share of half the size. 0: no layers. */
  strata?: number;
  /** Median thickness of a layer, as a share of half the size. */
  layer?: number;
  /** The angle between the layers and the horizontal. Its direction is random. */
  tilt?: number;
}

/** Heights as an image, for the algorithm image. */
export interface TerrainParametersImage {
  /** A PNG, JPEG, WebP or TIFF file, raw 16-bit samples or an .hgt file, in base64. A data: URL is accepted, too. The first row is the northern one. */
  data: string;
  /** How a pixel stores a height. From `low` to `high`: grey (also saved as RGB or with a palette); rgb24 and rgba32 pack a number into the channels, red highest; r16 and r16_big are raw unsigned samples without a header, low or high byte first. In metres: terrain_rgb (Mapbox), terrarium (Mapzen), metres (a TIFF or grey picture whose values are heights), s16 and s16_big (raw signed samples; -32768 is a void), hgt (SRTM). */
  encoding?: "grey" | "rgb24" | "rgba32" | "r16" | "r16_big" | "terrain_rgb" | "terrarium" | "metres" | "s16" | "s16_big" | "hgt";
  /** Samples in a row of raw data. Default: raw data are a square. */
  width?: number;
  /** Height of the value 0. */
  low?: number;
  /** Height of the greatest value that the encoding can hold. */
  high?: number;
  /** The first row is the southern one, as Unity has it. */
  flip?: boolean;
}

/** One piece of a larger world. The size is that of one tile. Tiles with a common border have the same heights along it, to the bit. */
export interface TerrainParametersTile {
  /** The column of the tile, counted eastwards. It may be negative without `across`. */
  x?: number;
  /** The row of the tile, counted southwards. It may be negative without `across`. */
  z?: number;
  /** The number of tiles along a side of the world. The faults of fault_formation and poisson_faulting cross this world; the default is then 1, and x and z are below this number. An island covers this world, with sea beyond. Hydraulic erosion requires this number: water runs over the whole world, which has at most 4,097 samples a side, and each tile is cut out of it. */
  across?: number;
}

/** Stretches the heights to a range. */
export interface TerrainParametersNormalise {
  /** The two heights that become low and high; heights outside them continue the same line. Default: the lowest and the highest of the field. Tiles require it, since a tile is computed without the heights of other tiles. */
  from?: [number, number];
  /** The lowest height. */
  low?: number;
  /** The highest height. */
  high?: number;
}

/** Lowers the rim, so that land is surrounded by sea. */
export interface TerrainParametersIsland {
  /** How far land extends from the centre, as a share of half the size. */
  reach?: number;
  /** How far the rim lies below the lowest height. Default: a quarter of the range of heights. */
  depth?: number;
  /** The height of the rim, instead of a depth. Tiles require it. */
  floor?: number;
  /** How much the coast deviates from a circle. */
  roughness?: number;
}

/** Steps of equal height. */
export interface TerrainParametersTerraces {
  /** The two heights between which the steps are counted; steps of the same height continue outside them. Default: the lowest and the highest of the field. Tiles require it. */
  from?: [number, number];
  /** Steps between the lowest and the highest height. */
  count?: number;
  /** 0 keeps the slope, 1 makes cliffs. */
  sharpness?: number;
}

/** Material on slopes that are steeper than `talus` slides down. */
export interface TerrainParametersThermal {
  /** Rounds; rock moves one sample in each round. */
  iterations?: number;
  /** The steepest stable slope. */
  talus?: number;
  /** Share of the excess height that moves in one round. */
  rate?: number;
}

/** Water removes ground and deposits it. */
export interface TerrainParametersHydraulic {
  /** droplets: single drops run down, erode and deposit. stream_power: rivers cut in proportion to the area that they drain. */
  method?: "droplets" | "stream_power";
  /** The number of drops. Default: 65536. */
  droplets?: number;
  /** The greatest length of the path of a drop. It is at most four times the sum of both sides of the field. Default: an eighth of the size. */
  lifetime?: number;
  /** How much a drop keeps its direction. Default: 0.1. */
  inertia?: number;
  /** How much ground running water can carry. Default: 4. */
  capacity?: number;
  /** Share of its free capacity that a drop removes in a step. Default: 0.3. */
  erosion?: number;
  /** Share of its excess load that a drop deposits in a step. Default: 0.3. */
  deposition?: number;
  /** Share of its water that a drop loses in a step. Default: 0.02. */
  evaporation?: number;
  /** The radius of erosion around a drop. Default: two samples; at most eight. */
  radius?: number;
  /** Steps of stream_power. Default: 20. */
  iterations?: number;
  /** How fast rivers cut in stream_power: the share of the slope to the next sample that is lost in a step if a hundredth of the terrain drains there. Default: 0.5. */
  strength?: number;
  /** How much more a larger river cuts in stream_power. Default: 0.5. */
  area_exponent?: number;
}

/** Finer ground around a point, such as a walking camera. Within the radius, the squares of the grid are divided until their sides are at most the step; further out, the step doubles with each radius until it is that of the grid. Small forms are added by the kind of ground: ledges and outcrops on rock, lumps on scree, hummocks on grass, ripples on sand and soil, low drifts on snow. They fade toward the outer edge of the refined area and toward the border of the field. Only for the shape plane with the mesh grid and without texture. */
export interface TerrainParametersRefine {
  /** The point, in metres to the east and south of the middle of the field or tile. */
  center?: [number, number];
  /** The distance from the point within which squares have this step. */
  radius?: number;
  /** The greatest side of the squares within the radius. It is less than the side of the squares of the grid. */
  step?: number;
  /** Factor of the heights of the small forms. 0: none, the ground is only smoother. */
  relief?: number;
}

/** Applies the heights to the surface of another model instead of a plane. They keep their metres and continue mirrored beyond their edges, so that there is no seam. The model keeps its materials. */
export interface TerrainParametersOnto {
  model: Child;
  /** displacement moves the surface along its normals by the heights. normal_map does not move it and adds a texture of slopes for lighting. Both project heights from three sides: displacement blends them by the direction of the surface, normal_map uses the nearest. */
  mapping?: "displacement" | "normal_map";
  /** How many times every triangle is divided into four before a displacement. */
  subdivide?: number;
}

/** The contents of the formats png16, png8, rgb24, rgba32 and r16. */
export interface TerrainParametersHeightmap {
  /** height; or a mask from 0 to 1: slope (of 90 degrees), curvature (0.5 is flat, larger values are ridges), flow (accumulated water), water (below the water level); or an image for png8: normal, color, splat (rock, grass, sand, snow in four channels); or one of four ground textures that repeat: rock, grass, sand, snow. */
  map?: "height" | "slope" | "curvature" | "flow" | "water" | "normal" | "color" | "splat" | "rock" | "grass" | "sand" | "snow";
  /** Height of the value 0. Default: the lowest height. */
  low?: number;
  /** Height of the greatest value. Default: the highest height. */
  high?: number;
  /** The byte order of r16. */
  byte_order?: "little" | "big";
  /** The southern row comes first, as Unity expects it. */
  flip?: boolean;
}

/** A height field by one of the classic algorithms, filtered, meshed and coloured, or as a height map for an engine; or a planetoid. */
export interface TerrainParameters {
  /** The algorithm. fault_formation and poisson_faulting lift one side of random lines. triangular_edge, diamond_square and square_square refine a few heights repeatedly. fbm sums octaves of noise. brownian is fractional Brownian motion along a line, for the shape profile. image takes heights from an image. expression computes each height. fracture breaks a solid along random planes, for rocks of the shape sphere. */
  algorithm?: "fault_formation" | "poisson_faulting" | "triangular_edge" | "diamond_square" | "square_square" | "fbm" | "brownian" | "image" | "expression" | "fracture";
  /** The height of a sample, for the algorithm expression: x and y are metres to the east and north of the centre. On a sphere, x, y and z are the position, and latitude and longitude are in degrees. size is the size of the terrain. noise(x, y) is gradient noise. fbm, ridged and billow(x, y, octaves) are sums of octaves of it. All of them also take a z. ran(high) and similar functions return another random number at each sample. */
  expression?: string;
  /** Further heights that are combined with those of the algorithm, one after the other, before the filters. */
  layers?: TerrainParametersLayersItem[];
  /** Rounds of a subdivision (n rounds give 2^n + 1 samples a side; square_square gives 2^n + 2), the number of faults, the octaves of noise, or the planes of fracture. Default: 8 rounds, 64 faults, 8 octaves, 16 planes. Not for image and expression. */
  iterations?: number;
  /** Additional iterations after the planned ones. A subdivision or noise becomes finer by that many rounds and keeps its old heights. Additional faults all have the bound fault_max. */
  extra_iterations?: number;
  /** Samples a side for algorithms that do not determine it: faults, fbm, brownian, expression and fracture. On a sphere, samples along an edge of its cube. Default: 257, on a sphere 65. */
  resolution?: number;
  /** Length of the terrain from west to east, or the diameter of a sphere. */
  size?: number;
  /** plane: a height field. sphere: a planetoid or a rock (fault_formation, poisson_faulting, fbm, expression and fracture). profile: the heights along one line from west to east, as a graph of lines (brownian and fbm). */
  shape?: "plane" | "sphere" | "profile";
  /** Subdivision: the greatest random deviation of the first round. Noise: the weight of the first octave. brownian: the standard deviation of the height difference between both ends. fracture: the height of the noise on the facets. Default: a tenth of the size, on a sphere a twentieth of the diameter, for fracture a sixtieth. */
  amplitude?: number;
  /** How fast the deviation falls with finer detail: every round or octave has 2^-hurst times the deviation of the one before. 1 is smooth, 0 is very rough. Default: 0.8. The mode random of triangular_edge does not use it. For brownian, it lies between 0 and 1, and heights at a distance d differ in proportion to d^hurst; the default is 0.5. */
  hurst?: number;
  /** Heights that a subdivision starts from: north-west, north-east, south-west, south-east. Default: drawn from the seed. */
  corners?: [number, number, number, number];
  /** The nine heights that square_square starts from, row by row from the north-west. Default: drawn from the seed. */
  grid?: number[];
  /** The rule of diamond_square for the missing fourth neighbour at the border. two_neighbours uses the two along the border, so that tiles fit together. avg3 uses the mean of three neighbours. interpolate computes the fourth from its neighbours. wrap takes it from the opposite side, so that the field repeats. Default: two_neighbours. */
  edge?: "two_neighbours" | "avg3" | "interpolate" | "wrap";
  /** For triangular_edge: random ignores the old heights; midpoint deviates from the mean of an edge's ends. Default: random. */
  mode?: "random" | "midpoint";
  /** Bound of the first fault's height, or for poisson_faulting its standard deviation. Later bounds fall linearly. Default: a fiftieth of the size. */
  fault_max?: number;
  /** The end value of the bound: fault i of n is bounded by max - (max - min) i / n. Default: 0. */
  fault_min?: number;
  /** The profile across a fault: hard is a step, line a slope, cosine a slope with rounded ends. Default: hard. */
  fault_step?: "hard" | "line" | "cosine";
  /** Width of the slope across a fault with the profile line or cosine. Default: an eighth of the size. */
  fault_width?: number;
  /** For fracture: the body that breaks, where it breaks, and its layers. */
  fracture?: TerrainParametersFracture;
  /** For fbm: rolling (fractal Brownian motion), ridged (ridged multifractal: sharp crests, smooth valleys) or billow (rounded hills). Default: rolling. */
  noise?: "rolling" | "ridged" | "billow";
  /** Size of the largest features of fbm. Default: a third of the size. */
  wavelength?: number;
  /** How many times finer each octave is than the one before. Default: 2. */
  lacunarity?: number;
  /** How far other noise displaces the ground of fbm before heights are taken. Default: 0. */
  warp?: number;
  /** Heights as an image, for the algorithm image. */
  image?: TerrainParametersImage;
  /** One piece of a larger world. The size is that of one tile. Tiles with a common border have the same heights along it, to the bit. */
  tile?: TerrainParametersTile;
  /** Strength of the low-pass filter that Kogovšek's thesis calls erosion: 0 changes nothing, 100 gives all samples one height. */
  smooth?: number;
  /** Stretches the heights to a range. */
  normalise?: TerrainParametersNormalise;
  /** Lowers the rim, so that land is surrounded by sea. */
  island?: TerrainParametersIsland;
  /** Steps of equal height. */
  terraces?: TerrainParametersTerraces;
  /** Material on slopes that are steeper than `talus` slides down. */
  thermal?: TerrainParametersThermal;
  /** Water removes ground and deposits it. */
  hydraulic?: TerrainParametersHydraulic;
  /** Samples a side of the finished field. They lie on a smooth curve through the old samples (Catmull-Rom). Most engines and rtin need 2^n + 1; Unreal accepts any number. Default: the samples of the algorithm. */
  resample?: number;
  /** grid: every sample. rtin: right triangles where needed, fast (2^n + 1 samples a side). greedy: the fewest triangles for an error, slower. */
  mesh?: "grid" | "rtin" | "greedy";
  /** The greatest vertical distance between a sample and an rtin or greedy mesh, checked at every sample. Default: a thousandth of the size. */
  max_error?: number;
  /** Height of a wall below the border that hides gaps between neighbours with different detail. */
  skirt?: number;
  /** Makes a closed solid for printing, with a floor at this distance below the lowest height. */
  base?: number;
  /** Finer ground around a point, such as a walking camera. Within the radius, the squares of the grid are divided until their sides are at most the step; further out, the step doubles with each radius until it is that of the grid. Small forms are added by the kind of ground: ledges and outcrops on rock, lumps on scree, hummocks on grass, ripples on sand and soil, low drifts on snow. They fade toward the outer edge of the refined area and toward the border of the field. Only for the shape plane with the mesh grid and without texture. */
  refine?: TerrainParametersRefine;
  /** Colours by height, slope and hollows. stone and mossy are those of rocks: light tops, and tops with moss. forest is the floor of a forest: fallen leaves and needles with patches of herbs. */
  palette?: "alpine" | "desert" | "tropical" | "arctic" | "volcanic" | "moon" | "stone" | "mossy" | "forest" | "grey" | "none";
  specular?: Specular;
  emission?: Emission;
  /** A surface of water at this height. On a sphere, the height is measured from its mean radius. */
  water_level?: number;
  /** Pixels a side of a colour texture and a normal map of the whole field, instead of vertex colours. 0: none. Not on a sphere. */
  texture?: number;
  /** Textures that repeat each two metres on the ground: grass, soil, rock, scree, sand, snow or litter by palette, height and slope, each with colour, normals and roughness. They multiply the vertex colours. Steep ground is mapped from its side. A sphere is rock. Not with texture, and not on a model. */
  detail?: boolean;
  /** Applies the heights to the surface of another model instead of a plane. They keep their metres and continue mirrored beyond their edges, so that there is no seam. The model keeps its materials. */
  onto?: TerrainParametersOnto;
  /** The contents of the formats png16, png8, rgb24, rgba32 and r16. */
  heightmap?: TerrainParametersHeightmap;
}

/** Roots that leave the foot of the trunk and run into the ground. They do not change the rest of the tree. */
export interface TreeParametersRoots {
  /** Number of roots. */
  count?: number;
  /** How far roots reach beyond the foot of the trunk, in radii of the trunk without its flare. */
  length?: number;
  /** Radius of a root where it begins, as a share of the radius of the trunk without its flare. */
  thickness?: number;
  /** Depth of the tips below the ground, as a share of the length. */
  depth?: number;
}

export type Seed = number | string;

/** A part with a seed of its own does not change with the seed of the request. In the model grown, parts compete for light and change each other. */
export interface TreeParametersSeeds {
  /** Seed of the trunk and of the roots. */
  trunk?: Seed;
  /** Seed of all limbs except the trunk. */
  branches?: Seed;
  /** Seed of the leaves. */
  leaves?: Seed;
}

/** Shape and appearance of the leaves. */
export interface TreeParametersLeaf {
  /** The kind of leaf: its outline and its texture. needles: short ones all around the shoot, as of spruces. pine_needles: long ones in pairs. */
  shape?: "simple" | "willow" | "birch" | "cordate" | "lobed" | "maple" | "ginkgo" | "compound" | "palmate" | "needles" | "pine_needles" | "palm" | "kite" | "petal";
  /** The mesh of a leaf. card: a square with a texture of the leaf. cross: two crossed squares. curved: a square bent like the leaf. mesh: the outline of the leaf. twig: a bent square with a texture of a twig with leaves. bunch: three twigs around the stem. Needles always have the texture of a twig. usual: bunch in the model proctree, card in the others. none: no leaves. */
  build?: "usual" | "none" | "card" | "cross" | "curved" | "mesh" | "twig" | "bunch";
  /** Whether leaves have the texture of their shape. auto: if they are made of squares. own: always. none: never. */
  picture?: "auto" | "own" | "none";
  /** Angle by which both halves of a leaf are raised about its midrib. */
  fold?: number;
  /** Angle by which a leaf bends down from its base to its tip. */
  droop?: number;
  /** Each step removes points from the margin of a leaf and rows from a bent square. Coarser levels of detail add to it. */
  coarseness?: number;
  /** Share of the leaves that are made, chosen at random. They keep their size. */
  density?: number;
  /** Factor for the length and width that the model gives. */
  size?: number;
  /** two_sided: one face that is visible from both sides; renderers invert its normal on the back side, and crowns seen from below are dark. outward: thin leaves with faces on both sides, whose normals turn out of the crown as far as they stay on the side of their faces. Such leaves have twice the triangles and no generated normal map. auto: two_sided in the profiles unreal and unity, whose foliage materials turn normals themselves, and outward otherwise. Leaves that share a mesh (output.instancing) are always two_sided. */
  faces?: "auto" | "two_sided" | "outward";
  /** Largest random angle by which a leaf turns about its length. Crowns whose leaves lie at all angles are denser from the side, and lighter from below. */
  roll?: number;
  /** 0 gives every leaf its own normals. 1 gives it the normals of the surface of the crown, so that distant crowns look smoother. */
  crown_normals?: number;
  /** Largest random difference in brightness between leaves. */
  tint?: number;
  /** Standard deviation of the hue between leaves, as vertex colours. Leaves of a limb, and leaves of a twig, resemble each other. If it is above 0, one leaf in fifty is withered. */
  hue?: number;
  /** Largest share of the light of the sky that leaves take from the leaves below them, as vertex colours. */
  occlusion?: number;
  /** Colour in summer. Petals have it in spring as well. */
  color?: string;
  /** Colour in autumn. If left out, leaves are yellow, and petals keep their colour. */
  autumn?: string;
  /** The tree keeps its leaves and their colour through the year. */
  evergreen?: boolean;
  specular?: Specular;
  emission?: Emission;
  /** Images instead of the generated texture of the leaf, tip up, each a PNG or JPEG file as a data URI. */
  images?: Images;
}

/** The tree in the wind at one moment, by the formulas of section 4.8 of Weber and Penn. Long and thin stems bend most, by at most 90 degrees. Lengths do not change. */
export interface TreeParametersSway {
  /** Speed of the wind: wind_speed in the paper. */
  wind?: number;
  /** Speed of gusts: wind_gust in the paper. */
  gust?: number;
  /** The moment. Short thick stems sway faster than long thin ones. */
  time?: number;
}

/** How limbs of one level grow. */
export interface TreeParametersEzTreeLevelItem {
  /** Angle between a limb of this level and its parent. The trunk has none. */
  angle?: number;
  /** Number of limbs of the next level on each limb of this level. */
  children?: number;
  /** Largest random turn of each section about two axes, in radians. Thin sections turn more. */
  gnarliness?: number;
  /** Length of a limb, in units of the model. */
  length?: number;
  /** Radius of the trunk in units of the model, or of a limb as a share of its parent where it begins. */
  radius?: number;
  /** Number of straight sections of a limb. */
  sections?: number;
  /** Share of the parent at its foot without limbs of this level. */
  start?: number;
  /** Share of the radius that a limb loses from foot to tip. */
  taper?: number;
  /** Turn of each section about its own axis, in radians. */
  twist?: number;
}

/** A grid of bars that attracts limbs. It is not drawn. Lengths are units of the model. */
export interface TreeParametersEzTreeTrellis {
  /** Bends limbs toward the trellis. */
  enabled?: boolean;
  /** Middle of the trellis across. */
  x?: number;
  /** Lower edge of the trellis. */
  y?: number;
  /** Distance of the trellis from the trunk. */
  z?: number;
  /** Width of the trellis. */
  width?: number;
  /** Height of the trellis. */
  height?: number;
  /** Distance between its bars. */
  spacing?: number;
  /** Turn toward the nearest bar, in radians, for a limb of radius 1. */
  strength?: number;
  /** Distance beyond which the trellis has no effect. */
  max_distance?: number;
  /** Power by which the effect falls with the distance. */
  falloff?: number;
}

/** Parameters of the model ez_tree: limbs of straight sections, with the random sequence of ez-tree 1.1 for the seed of the request. Lengths are units of the model, which `scale` turns into metres. */
export interface TreeParametersEzTree {
  /** Metres for each unit of length. */
  scale?: number;
  /** Limbs become shorter toward the top, and end in points. Limbs of other trees continue in a limb of the next level. */
  evergreen?: boolean;
  /** Number of levels of branching beyond the trunk. */
  levels?: number;
  /** The trunk and the levels after it. The last entry applies to all further levels. An empty list means the values of a new tree of ez-tree. */
  level?: TreeParametersEzTreeLevelItem[];
  /** Component of the direction toward which limbs bend. */
  force_x?: number;
  /** Component of the direction toward which limbs bend. */
  force_y?: number;
  /** Component of the direction toward which limbs bend. */
  force_z?: number;
  /** Turn of a section of radius 1 toward that direction, in radians. Negative values turn away from it. */
  force_strength?: number;
  /** Angle between leaves and their limb. */
  leaf_angle?: number;
  /** Number of leaves on each limb of the last level. The tip of such a limb has one more, unless the form is evergreen. */
  leaf_count?: number;
  /** Share of the limb at its foot without leaves. */
  leaf_start?: number;
  /** Length and width of a leaf, in units of the model. */
  leaf_size?: number;
  /** Largest random difference of the size, as a share of it. */
  leaf_size_variance?: number;
  /** A grid of bars that attracts limbs. It is not drawn. Lengths are units of the model. */
  trellis?: TreeParametersEzTreeTrellis;
}

/** How limbs of one level are made. */
export interface TreeParametersSculptLevelItem {
  /** The body about the axis of a limb into which its own limbs must fit. lathe has the outline of the list profile. */
  shape?: "box" | "sphere" | "cone" | "cylinder" | "lathe";
  /** Largest half width of the bounding shape as a share of the length. */
  width?: number;
  /** Half widths of the lathe shape at even steps from foot to tip, as shares of the width. */
  profile?: number[];
  /** Length of limbs as a share of the distance to the bounding shape. */
  fill?: number;
  /** Largest random reduction of that length, as a share of it. */
  fill_spread?: number;
  /** Share of the limb at its foot without limbs. */
  start?: number;
  /** Distance from the foot to the first whorl and from there to the second, as a share of the length. */
  gap?: number;
  /** Ratio of each gap to the one before it. Below 1, whorls are closer together toward the tip. */
  gap_ratio?: number;
  /** Number of limbs that leave the axis at one point. */
  whorl?: number;
  /** Probability that a limb of a whorl is made. */
  chance?: number;
  /** Angle between limbs and the axis at its foot. */
  angle?: number;
  /** Angle between limbs and the axis at its tip. In between, the angle changes linearly. */
  angle_tip?: number;
  /** Largest random difference of the angle to either side. */
  angle_spread?: number;
  /** Angle about the axis from one whorl to the next. */
  phase?: number;
  /** Largest random difference of the position of each limb about the axis, to either side. */
  phase_spread?: number;
  /** Angle between each segment and the one before it. */
  bend?: number;
  /** Largest random difference of the bend to either side. */
  bend_spread?: number;
  /** Turn of each segment about its own axis, so that bends form a spiral instead of an arc. */
  spin?: number;
  /** Angle by which the limb becomes narrower from foot to tip. */
  taper?: number;
  /** Turns the limb toward the sky over its length, or toward the ground if negative. */
  rise?: number;
}

/** Parameters of the model sculpt: limbs in whorls that fit into a bounding shape, after P. Kruszewski, An algorithm for sculpting trees, Computers and Graphics 23(5), 1999. The names are our own. */
export interface TreeParametersSculpt {
  /** Length of the trunk. */
  height?: number;
  /** Largest random difference of the height, as a share of it. */
  height_spread?: number;
  /** Number of levels of branching, including the trunk. */
  levels?: number;
  /** Shorter limbs are not made. Limbs of exactly this length do not branch. */
  shortest?: number;
  /** Radius of the trunk at its foot. 0: it follows from the taper of the trunk. */
  trunk_radius?: number;
  /** How the number of corners of cross-sections falls. usual: with the 0.3rd power of the radius. linear: in proportion to the radius, and linearly to a sixth at a range of 500 m, where no limb is left out. */
  faces?: "usual" | "linear";
  /** Radius of every limb at its end. */
  tip_radius?: number;
  /** Angle between the trunk and the vertical. */
  lean?: number;
  /** The levels in order: the trunk, its limbs, their limbs. The last entry applies to all further levels. */
  level?: TreeParametersSculptLevelItem[];
  /** Number of leaves on each limb of the last two levels and on limbs that are too short to branch. The trunk has leaves only if there is no other level. */
  leaves?: number;
  /** Length of a leaf. */
  leaf_length?: number;
  /** Width of a leaf as a share of its length. */
  leaf_width?: number;
  /** Angle between leaves and their limb. */
  leaf_angle?: number;
}

/** Shadow propagation: each internode darkens its cell and a pyramid of cells below it. */
export interface TreeParametersGrownLight {
  /** The width of a cell. If left out, the length of an internode. */
  cell?: number;
  /** The share of the light that an internode of the length `internode` removes from its own cell: a in the paper. */
  shade?: number;
  /** The divisor of the shade from layer to layer: b in the paper. */
  falloff?: number;
  /** The depth of a shadow in layers of cells. */
  layers?: number;
}

/** One solid. */
export interface TreeParametersGrownObstaclesItem {
  /** A shape that fills its size. */
  shape: "box" | "sphere" | "cylinder" | "cone";
  /** The middle of the lower face of the box around the shape. */
  position?: [number, number, number];
  /** Width, height and depth of the shape. */
  size?: [number, number, number];
}

/** One tree. */
export interface TreeParametersGrownNeighboursItem {
  /** X and Z of its foot. */
  position: [number, number];
}

/** How axes of one level grow. */
export interface TreeParametersGrownLevelItem {
  /** Angle between the side shoots of such an axis and the axis. */
  angle?: number;
  /** Largest random difference of the angle to either side. */
  angle_spread?: number;
  /** Number of side buds at each internode's end: 1 alternate, 2 opposite, more for a whorl. */
  buds?: number;
  /** Number of side buds at the end of the shoot of a year, instead of `buds`. 0: as at the other internodes. */
  whorl?: number;
  /** Angle about the axis from the buds of one internode to those of the next. For opposite buds, 90 is usual. */
  phyllotaxis?: number;
  /** Largest random difference of the position of a bud about the axis, to either side. */
  phyllotaxis_spread?: number;
  /** Weight of the direction of the most light against the direction in which the axis grows: ξ in the paper. */
  light?: number;
  /** Weight of the direction up, or down if negative, against the direction in which the axis grows: η in the paper. */
  tropism?: number;
  /** Share of its slope that an axis loses with each internode, so that it becomes horizontal. */
  level_out?: number;
  /** Largest random angle between an internode and the one before it. */
  wander?: number;
  /** Length of internodes as a share of `internode`. */
  length?: number;
}

/** Parameters of the model grown: buds compete for light year by year, after Palubicki and others, Self-organizing tree models for image synthesis, SIGGRAPH 2009. The tree has mature_age years, or `age` years if it is younger. */
export interface TreeParametersGrown {
  /** Length of an internode that grows with a vigour of 1, the unit of the model. Cells of the light have this size unless `cell` is given. */
  internode?: number;
  /** Vigour of the tree in a year for each bud in full light. 1 is what an internode needs. */
  alpha?: number;
  /** Largest number of internodes that a bud grows in a year. */
  longest_shoot?: number;
  /** How vigour is divided among branches. borchert_honda: at each fork by the light of both sides and `lambda`. priority: along each axis by rank of the mean light, which gives strong leaders. */
  allocation?: "borchert_honda" | "priority";
  /** Apical control of a young tree: the weight of the axis that continues against its side branches. Below 0.5 side branches are favoured: bushes 0.46, trees with a trunk 0.56. */
  lambda?: number;
  /** Apical control from the second year of `lambda_years` on. */
  lambda_old?: number;
  /** Apical control falls, or rises, from `lambda` to `lambda_old` between these two years. */
  lambda_years?: [number, number];
  /** Weight of the branches of the lowest rank against the branch of the first rank: w_min by w_max in the paper, which uses 0.006 with unlimited shoots. Low values leave bare stems. */
  priority_least?: number;
  /** Share of the branches of an axis, in the order of their ranks, over which weights fall to `priority_least`: κ in the paper. */
  priority_share?: number;
  /** Shadow propagation: each internode darkens its cell and a pyramid of cells below it. */
  light?: TreeParametersGrownLight;
  /** Distance at which a bud samples the light to find its direction, in internodes. */
  perception_distance?: number;
  /** Angle between the direction of a bud and the outermost samples of the light. */
  perception_angle?: number;
  /** Years after which a bud that does not grow dies. */
  bud_years?: number;
  /** Probability that the bud at the end of an axis dies in a year, so that a side shoot takes over. */
  takeover?: number;
  /** Number of levels of branching, including the trunk. Axes of the last level have no side buds. */
  levels?: number;
  /** A branch is shed if its vigour for each of its internodes younger than `shed_years` is below this value. 0: only branches without any light are shed. */
  shed?: number;
  /** Age at which a branch can be shed. Internodes of this age no longer count for the threshold. */
  shed_years?: number;
  /** Exponent n of the pipe model: the nth power of the radius below a fork is the sum of those above it. Wood of shed branches stays. 2 keeps the cross-section. */
  radius_exponent?: number;
  /** Radius of the youngest wood. */
  tip_radius?: number;
  /** Least height of branches above the ground. The trunk has no side buds below it, and shoots that come lower end. */
  clearance?: number;
  /** Number of leaves, or of twigs with leaves, at each internode that bears them. */
  leaves?: number;
  /** Age of the wood that bears leaves. 1: shoots of the last year alone. */
  leaf_years?: number;
  /** Length of a leaf. */
  leaf_length?: number;
  /** Width of a leaf as a share of its length. */
  leaf_width?: number;
  /** Angle between a leaf and its shoot. */
  leaf_angle?: number;
  /** How far leaves turn their upper side out of the crown to the light. 0: not at all. 1: completely. */
  leaf_bend?: number;
  /** Solids that shoots grow around, and that cast shade. They are not part of the model. */
  obstacles?: TreeParametersGrownObstaclesItem[];
  /** Trees of the same parameters and other seeds that grow beside this one and compete with it for light. They are not part of the model. */
  neighbours?: TreeParametersGrownNeighboursItem[];
  /** Axes in order: the trunk, its branches, their branches. The last entry applies to all further levels. */
  level?: TreeParametersGrownLevelItem[];
}

/** A tree by one of five models: weber_penn (Weber and Penn, 1995), proctree (Paul Brunt, 2012), sculpt (Kruszewski, 1999), ez_tree (Daniel Greenheck, 2024) or grown (Palubicki and others, 2009). Parameters of the first two models have their published names. */
export interface TreeParameters {
  /** The algorithm that grows the tree. Parameters of the other models have no effect, and a warning reports each that is given. */
  model?: "weber_penn" | "proctree" | "sculpt" | "ez_tree" | "grown";
  /** Number of corners of the cross-section of the thickest limb. Thinner limbs have fewer. The model proctree uses mSegments instead. */
  sides?: number;
  /** Joins all limbs into one surface. Limbs of similar thickness meet in a fork, thin limbs leave a thick one through a collar. If false, every limb is a closed tube that begins inside its parent, which needs fewer triangles. */
  weld?: boolean;
  /** Limbs that begin with a smaller radius have no bark. Their leaves stay. */
  twig_radius?: number;
  /** The distance from which the tree is seen. A distant tree has fewer corners, limbs and leaves, by the formulas of section 4.9 of Weber and Penn. The image is 1,000 pixels high and has a field of view of 60 degrees. The remaining leaves are larger, so that the crown stays dense. 0 keeps everything. */
  range?: number;
  /** How much the trunk widens at the ground, as a share of the radius that the model gives it. The flare ends at an eighth of the height. */
  trunk_flare?: number;
  /** Roots that leave the foot of the trunk and run into the ground. They do not change the rest of the tree. */
  roots?: TreeParametersRoots;
  /** A part with a seed of its own does not change with the seed of the request. In the model grown, parts compete for light and change each other. */
  seeds?: TreeParametersSeeds;
  /** Shape and appearance of the leaves. */
  leaf?: TreeParametersLeaf;
  /** The generated texture of trunk and limbs. It has no visible seam around a limb; thin limbs show a strip of it, with 1/2 to 1/64 of its width. none: a plain colour, with texture coordinates in metres. */
  bark?: "none" | "oak_bark" | "pine_bark" | "spruce_bark" | "willow_bark" | "birch_bark" | "beech_bark" | "cherry_bark" | "palm_bark" | "cedar_bark";
  /** The main colour of the bark. If left out, the texture has its own colour, and plain bark is brown. */
  bark_color?: string;
  /** Another seed gives another texture of the same kind. Trees with the same bark, seed and colour share a texture. */
  bark_seed?: number;
  /** Images instead of the generated texture of the bark, each a PNG or JPEG file as a data URI. */
  bark_images?: Images;
  bark_specular?: Specular;
  bark_emission?: Emission;
  /** Years since the seed sprouted. The shape changes continuously with the age. If left out or above mature_age, the tree is full-grown. */
  age?: number;
  /** Years after which the tree has the size that its parameters describe. In the model grown, the years that it grows. */
  mature_age?: number;
  /** Season of the leaves. In winter only evergreen trees have leaves. The model also contains the other seasons with leaves as material variants (KHR_materials_variants). */
  season?: "spring" | "summer" | "autumn" | "winter";
  /** Outline of the crown: 0 conical, 1 spherical, 2 hemispherical, 3 cylindrical, 4 tapered cylindrical, 5 flame, 6 inverse conical, 7 tend flame, 8 the envelope of the pruning parameters. */
  Shape?: number;
  /** Number of levels of branching, including the trunk. Leaves grow on the last level. */
  Levels?: number;
  /** Height of the tree, before 0Length is applied. */
  Scale?: number;
  /** Largest random difference of the height to either side. */
  ScaleV?: number;
  /** Share of the height without branches. */
  BaseSize?: number;
  /** Radius of the trunk as a share of its length. */
  Ratio?: number;
  /** The radius of a child is that of its parent times the ratio of their lengths to this power. */
  RatioPower?: number;
  /** How much wider the trunk is at the ground, as a share of its radius. */
  Flare?: number;
  /** Ribs around the cross-section of the trunk. */
  Lobes?: number;
  /** Height of the ribs as a share of the radius. */
  LobeDepth?: number;
  /** Factor for the radius of the trunk. */
  "0Scale"?: number;
  /** Largest random difference of 0Scale to either side. */
  "0ScaleV"?: number;
  /** Number of additional stems into which the trunk divides at the end of its first segment. */
  "0BaseSplits"?: number;
  /** Number of trunks, each with a length and a bend of its own. */
  "0Branches"?: number;
  /** Greatest distance of a trunk from the origin. The distances are random. */
  "0BranchDist"?: number;
  /** Bends limbs of level 2 and above toward the sky, or toward the ground if negative. 1 makes the last segment of a limb upright. */
  AttractionUp?: number;
  /** How far limbs that leave the envelope are shortened. 0: not at all. 1: they end inside. */
  PruneRatio?: number;
  /** Widest radius of the envelope as a share of the height. */
  PruneWidth?: number;
  /** Share of the crown, from its base, at which the envelope is widest. */
  PruneWidthPeak?: number;
  /** Curvature of the envelope below its peak. */
  PrunePowerLow?: number;
  /** Curvature of the envelope above its peak. */
  PrunePowerHigh?: number;
  /** The tree in the wind at one moment, by the formulas of section 4.8 of Weber and Penn. Long and thin stems bend most, by at most 90 degrees. Lengths do not change. */
  sway?: TreeParametersSway;
  /** Largest number of leaves on a limb of the last level. If negative, its absolute value is the number of leaves in a fan at the end of the limb. */
  Leaves?: number;
  /** How the number of leaves of a limb depends on its position along the parent: the number of a crown shape (Shape). The paper has 4. */
  LeafDistrib?: number;
  /** The source of the formulas for the numbers of stems, branches and leaves. paper: Weber and Penn (1995). A stem and its clones share its branches and leaves, and each split makes further splits half as likely. arbaro: the program Arbaro, as for imported species of Arbaro. A stem and its clones share its branches, but each has as many leaves per segment as a stem without clones. Splits do not become rarer, numbers of branches are rounded down, and pruned limbs stay. sapling: Blender's Sapling, where numbers of branches and leaves follow from the lengths of their stems. Branches and leaves below the base of a stem are left out. */
  counting?: "paper" | "arbaro" | "sapling";
  /** Length of a leaf. */
  LeafScale?: number;
  /** Width of a leaf as a share of its length. */
  LeafScaleX?: number;
  /** How far leaves turn outward and to the light: the parameter bend in the paper. */
  LeafBend?: number;
  /** Length of the trunk as a share of the scale. */
  "0Length"?: number;
  /** Largest random difference of the length to either side. */
  "0LengthV"?: number;
  /** 0: a cylinder. 1: a cone. 2: a cone with a round end. 3: a row of spheres. */
  "0Taper"?: number;
  /** Average number of additional stems into which a segment divides. */
  "0SegSplits"?: number;
  /** Angle between the stems of a split and the axis before it. */
  "0SplitAngle"?: number;
  /** Largest random difference of the split angle to either side. */
  "0SplitAngleV"?: number;
  /** Number of segments of the axis. 0, which published parameters have where a level has no limbs, counts as 1. */
  "0CurveRes"?: number;
  /** Bend of the whole axis, downward if positive. If CurveBack is not 0, bend of its first half. */
  "0Curve"?: number;
  /** Bend of the second half of the axis. */
  "0CurveBack"?: number;
  /** Largest sum of random bends along the axis. If negative, the axis is a helix that leans by this angle. */
  "0CurveV"?: number;
  /** Angle between limbs of level 1 and their parent. */
  "1DownAngle"?: number;
  /** Largest random difference of the down angle. If negative, the angle changes with the height: limbs are steeper toward the top of the crown. */
  "1DownAngleV"?: number;
  /** Angle about the parent from one limb to the next. If negative, limbs are on alternate sides. */
  "1Rotate"?: number;
  /** Largest random difference of the turn to either side. */
  "1RotateV"?: number;
  /** Greatest number of limbs of level 1 on one parent. */
  "1Branches"?: number;
  /** Share of each segment of the parent, from its base, on which limbs of level 1 begin. 1: limbs are evenly spread. 0: all begin where the segment begins. */
  "1BranchDist"?: number;
  /** Number of limbs of level 1 that begin at the same height, evenly around their parent. 1Rotate, 2Rotate or 3Rotate turns one whorl against the next. */
  "1Whorl"?: number;
  /** Share of the length of limbs of level 1 without branches and leaves. */
  "1BaseSize"?: number;
  /** Length of limbs of level 1 as a share of their parent. */
  "1Length"?: number;
  /** Largest random difference of the length to either side. */
  "1LengthV"?: number;
  /** 0: a cylinder. 1: a cone. 2: a cone with a round end. 3: a row of spheres. */
  "1Taper"?: number;
  /** Average number of additional stems into which a segment divides. */
  "1SegSplits"?: number;
  /** Angle between the stems of a split and the axis before it. */
  "1SplitAngle"?: number;
  /** Largest random difference of the split angle to either side. */
  "1SplitAngleV"?: number;
  /** Number of segments of the axis. 0, which published parameters have where a level has no limbs, counts as 1. */
  "1CurveRes"?: number;
  /** Bend of the whole axis, downward if positive. If CurveBack is not 0, bend of its first half. */
  "1Curve"?: number;
  /** Bend of the second half of the axis. */
  "1CurveBack"?: number;
  /** Largest sum of random bends along the axis. If negative, the axis is a helix that leans by this angle. */
  "1CurveV"?: number;
  /** Angle between limbs of level 2 and their parent. */
  "2DownAngle"?: number;
  /** Largest random difference of the down angle. If negative, the angle changes with the height: limbs are steeper toward the top of the crown. */
  "2DownAngleV"?: number;
  /** Angle about the parent from one limb to the next. If negative, limbs are on alternate sides. */
  "2Rotate"?: number;
  /** Largest random difference of the turn to either side. */
  "2RotateV"?: number;
  /** Greatest number of limbs of level 2 on one parent. */
  "2Branches"?: number;
  /** Share of each segment of the parent, from its base, on which limbs of level 2 begin. 1: limbs are evenly spread. 0: all begin where the segment begins. */
  "2BranchDist"?: number;
  /** Number of limbs of level 2 that begin at the same height, evenly around their parent. 1Rotate, 2Rotate or 3Rotate turns one whorl against the next. */
  "2Whorl"?: number;
  /** Share of the length of limbs of level 2 without branches and leaves. */
  "2BaseSize"?: number;
  /** Length of limbs of level 2 as a share of their parent. */
  "2Length"?: number;
  /** Largest random difference of the length to either side. */
  "2LengthV"?: number;
  /** 0: a cylinder. 1: a cone. 2: a cone with a round end. 3: a row of spheres. */
  "2Taper"?: number;
  /** Average number of additional stems into which a segment divides. */
  "2SegSplits"?: number;
  /** Angle between the stems of a split and the axis before it. */
  "2SplitAngle"?: number;
  /** Largest random difference of the split angle to either side. */
  "2SplitAngleV"?: number;
  /** Number of segments of the axis. 0, which published parameters have where a level has no limbs, counts as 1. */
  "2CurveRes"?: number;
  /** Bend of the whole axis, downward if positive. If CurveBack is not 0, bend of its first half. */
  "2Curve"?: number;
  /** Bend of the second half of the axis. */
  "2CurveBack"?: number;
  /** Largest sum of random bends along the axis. If negative, the axis is a helix that leans by this angle. */
  "2CurveV"?: number;
  /** Angle between limbs of level 3 and beyond and their parent. */
  "3DownAngle"?: number;
  /** Largest random difference of the down angle. If negative, the angle changes with the height: limbs are steeper toward the top of the crown. */
  "3DownAngleV"?: number;
  /** Angle about the parent from one limb to the next. If negative, limbs are on alternate sides. */
  "3Rotate"?: number;
  /** Largest random difference of the turn to either side. */
  "3RotateV"?: number;
  /** Greatest number of limbs of level 3 and beyond on one parent. */
  "3Branches"?: number;
  /** Share of each segment of the parent, from its base, on which limbs of level 3 begin. 1: limbs are evenly spread. 0: all begin where the segment begins. */
  "3BranchDist"?: number;
  /** Number of limbs of level 3 that begin at the same height, evenly around their parent. 1Rotate, 2Rotate or 3Rotate turns one whorl against the next. */
  "3Whorl"?: number;
  /** Share of the length of limbs of level 3 without branches and leaves. */
  "3BaseSize"?: number;
  /** Length of limbs of level 3 and beyond as a share of their parent. */
  "3Length"?: number;
  /** Largest random difference of the length to either side. */
  "3LengthV"?: number;
  /** 0: a cylinder. 1: a cone. 2: a cone with a round end. 3: a row of spheres. */
  "3Taper"?: number;
  /** Average number of additional stems into which a segment divides. */
  "3SegSplits"?: number;
  /** Angle between the stems of a split and the axis before it. */
  "3SplitAngle"?: number;
  /** Largest random difference of the split angle to either side. */
  "3SplitAngleV"?: number;
  /** Number of segments of the axis. 0, which published parameters have where a level has no limbs, counts as 1. */
  "3CurveRes"?: number;
  /** Bend of the whole axis, downward if positive. If CurveBack is not 0, bend of its first half. */
  "3Curve"?: number;
  /** Bend of the second half of the axis. */
  "3CurveBack"?: number;
  /** Largest sum of random bends along the axis. If negative, the axis is a helix that leans by this angle. */
  "3CurveV"?: number;
  /** The seed if that of the request is 0, or if `sequence` is original. Only with `sequence` original, the tree is the one that proctree makes from this seed. */
  mSeed?: number;
  /** Number of corners of the cross-sections, which is even. 2 gives 3 corners. */
  mSegments?: number;
  /** Number of times that a branch forks. */
  mLevels?: number;
  /** Texture lengths per metre of bark. */
  mVMultiplier?: number;
  /** Half the side of the square that represents a twig. */
  mTwigScale?: number;
  /** Length of the branches of the first fork. */
  mInitialBranchLength?: number;
  /** Factor for the length from fork to fork. */
  mLengthFalloffFactor?: number;
  /** Exponent of the length from fork to fork. */
  mLengthFalloffPower?: number;
  /** Largest share of the direction of its parent that a branch keeps. */
  mClumpMax?: number;
  /** Smallest share of the direction of its parent that a branch keeps. */
  mClumpMin?: number;
  /** How far the second branch of a fork is mirrored against the first. */
  mBranchFactor?: number;
  /** Raises branches in proportion to their depth, or lowers them if negative. */
  mDropAmount?: number;
  /** Raises branches, most of all near the trunk. */
  mGrowAmount?: number;
  /** Bends branches along X in proportion to their depth, like wind. */
  mSweepAmount?: number;
  /** Radius of the trunk. */
  mMaxRadius?: number;
  /** Rise of the trunk from fork to fork. */
  mClimbRate?: number;
  /** Sideways displacement of the trunk from fork to fork. */
  mTrunkKink?: number;
  /** Forks along the trunk. */
  mTreeSteps?: number;
  /** Factor for the radius of the trunk from fork to fork. */
  mTaperRate?: number;
  /** Factor for the radius of a branch from fork to fork. */
  mRadiusFalloffRate?: number;
  /** Turns of the branches about the trunk. */
  mTwistRate?: number;
  /** Height of the first fork. */
  mTrunkLength?: number;
  /** keyed: each fork has random numbers of its own. original: the numbers of proctree.js, so that the skeleton for `mSeed` equals that of the original, whatever the seed of the request. */
  sequence?: "keyed" | "original";
  /** Parameters of the model ez_tree: limbs of straight sections, with the random sequence of ez-tree 1.1 for the seed of the request. Lengths are units of the model, which `scale` turns into metres. */
  ez_tree?: TreeParametersEzTree;
  /** Parameters of the model sculpt: limbs in whorls that fit into a bounding shape, after P. Kruszewski, An algorithm for sculpting trees, Computers and Graphics 23(5), 1999. The names are our own. */
  sculpt?: TreeParametersSculpt;
  /** Parameters of the model grown: buds compete for light year by year, after Palubicki and others, Self-organizing tree models for image synthesis, SIGGRAPH 2009. The tree has mature_age years, or `age` years if it is younger. */
  grown?: TreeParametersGrown;
}

/** The shape of the ground. */
export interface WorldParametersRelief {
  /** Whether ground below the sea level is covered by the sea. Without it, rivers end in lakes. */
  sea?: boolean;
  /** The height of the sea. A region without a coast has its lake at its lowest point. */
  sea_level?: number;
  /** The share of land: 0 is nearly all sea, 1 nearly all land. */
  land?: number;
  /** The wavelength of land and sea. */
  continents?: number;
  /** The height of the greatest mountain ranges. */
  mountains?: number;
  /** The height of hills. */
  hills?: number;
  /** How sharp the crests of mountains are: 0 is round, 1 sharp. */
  ridges?: number;
  /** The strength of gullies along slopes. */
  gullies?: number;
  /** How much of the slopes forms steps, as in layered rock. */
  terraces?: number;
}

/** Rivers and lakes. The water of each region of about 32 km drains to the sea or to a lake inside it. */
export interface WorldParametersWater {
  /** The amount of rivers: 0 is none, 1 many. */
  rivers?: number;
  /** The width of a river that drains 100 km². */
  width?: number;
}

/** Temperature and moisture, which determine colours and plants. */
export interface WorldParametersClimate {
  /** The mean temperature at the sea level. */
  temperature?: number;
  /** The mean moisture: 0 is desert, 1 rain forest. */
  moisture?: number;
  /** How much moisture and temperature vary over the world. */
  variation?: number;
}

/** The colours of the ground and of water. */
export interface WorldParametersColors {
  /** The colour of grass. */
  grass?: string;
  /** The colour of the ground of woods. */
  forest?: string;
  /** The colour of dry ground. */
  dry?: string;
  /** The colour of rock. */
  rock?: string;
  /** The colour of sand. */
  sand?: string;
  /** The colour of snow. */
  snow?: string;
  /** The colour of water. */
  water?: string;
}

/** Settlements that the generator city plans: streets, blocks and lots on the ground of the world. */
export interface WorldParametersSettlementsTowns {
  /** The share of settlements that are towns. Beside rivers and coasts there are more, elsewhere fewer. */
  share?: number;
  /** The radius of the widest town. */
  radius?: number;
  /** The share of towns with a wall around them. */
  walls?: number;
  /** A request of the generator city. Its streets, lots and building rules are those of towns. The world gives area, ground, density and given streets, and draws the houses. */
  city?: Child;
}

/** House */
export interface WorldParametersSettlementsHousesItem {
  /** A request of the generator building. */
  model: Child;
  /** The frequency of this house, relative to the sum of all shares. */
  share?: number;
}

/** Villages and farms on level ground near water, outside of cold and dry regions. */
export interface WorldParametersSettlements {
  /** The share of suitable locations that have a village. Each square with sides of about 6 km has at most one location. */
  density?: number;
  /** The radius of the widest village. */
  radius?: number;
  /** The colour of walls. */
  wall?: string;
  /** The colour of roofs. */
  roof?: string;
  /** Settlements that the generator city plans: streets, blocks and lots on the ground of the world. */
  towns?: WorldParametersSettlementsTowns;
  /** Houses of villages by requests of the generator building. Without one, houses have walls and a gable roof. */
  houses?: WorldParametersSettlementsHousesItem[];
}

/** Roads between villages, with a grade of at most 10 %. */
export interface WorldParametersRoads {
  /** The width of the carriageway. */
  width?: number;
  /** The greatest distance of two villages that a road joins. */
  longest?: number;
  /** The colour of roads. */
  color?: string;
}

/** Fields around villages, where the ground is level and dry. Nothing else grows on them. */
export interface WorldParametersFields {
  /** The share of suitable ground around a village that is fields. */
  share?: number;
  /** The mean side of a field. */
  size?: number;
  /** The distance from the middle of a village up to which there are fields, as a multiple of the radius of the village. */
  reach?: number;
  /** The colours of crops. */
  colors?: string[];
}

/** Class */
export interface WorldParametersPlantsItem {
  /** The name of the class in the map. */
  class: string;
  /** The form of the plant if it has no model. It also determines the width of crowns in woods that are seen from far away. */
  form?: "conifer" | "broadleaf" | "palm" | "shrub" | "cactus" | "fungus";
  /** A request of the generator tree or lsystem. Its model is scaled to the height. Near the camera it has 1,500 triangles, or more if it cannot be simplified that far; farther away, its impostor is shown. */
  model?: Child;
  /** The mean height. Copies have 0.7 to 1.3 times this height. */
  height?: number;
  /** The least distance between two plants of the class. */
  spacing?: number;
  /** The share of suitable ground that the class covers. */
  density?: number;
  /** The least and the greatest moisture at which the class grows. */
  moisture?: [number, number];
  /** The least and the greatest temperature at which the class grows. */
  temperature?: [number, number];
  /** The steepest ground that the class grows on. */
  slope?: number;
  /** The least and the greatest height above the sea level at which the class grows. */
  heights?: [number, number];
  /** The biomes in which the class grows. Without one, it grows in all. Biomes follow from temperature and moisture. */
  biomes?: ("ice" | "tundra" | "taiga" | "steppe" | "grassland" | "forest" | "desert" | "savanna" | "rainforest")[];
  /** The colour of leaves. */
  color?: string;
  /** The colour of stems. */
  stem?: string;
}

/** A plane of land and sea that is generated from a seed and streamed as OGC 3D Tiles 1.1. A tile depends on the request and its address alone. */
export interface WorldParameters {
  /** The side of the square that is streamed: a power of two from 2^15. Leaves have a side of 64 m. */
  extent?: number;
  /** The position of the middle of the world on the infinite plane, east and north, in regions of 32,768 m. */
  origin?: [number, number];
  /** The layers that tiles contain. */
  layers?: ("terrain" | "water" | "roads" | "buildings" | "plants")[];
  /** The shape of the ground. */
  relief?: WorldParametersRelief;
  /** Rivers and lakes. The water of each region of about 32 km drains to the sea or to a lake inside it. */
  water?: WorldParametersWater;
  /** Temperature and moisture, which determine colours and plants. */
  climate?: WorldParametersClimate;
  /** The colours of the ground and of water. */
  colors?: WorldParametersColors;
  /** Villages and farms on level ground near water, outside of cold and dry regions. */
  settlements?: WorldParametersSettlements;
  /** Roads between villages, with a grade of at most 10 %. */
  roads?: WorldParametersRoads;
  /** Fields around villages, where the ground is level and dry. Nothing else grows on them. */
  fields?: WorldParametersFields;
  /** Classes of plants. Copies of one class keep their spacing, also across the borders of tiles. */
  plants?: WorldParametersPlantsItem[];
}

/** A request with this generator. */
export interface BuildingChild {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "building";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: BuildingParameters;
}

/** A request with this generator. */
export interface CityChild {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "city";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: CityParameters;
}

/** A request with this generator. */
export interface FractalChild {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "fractal";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: FractalParameters;
}

/** A request with this generator. */
export interface LsystemChild {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "lsystem";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: LsystemParameters;
}

/** A request with this generator. */
export interface SceneChild {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "scene";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: SceneParameters;
}

/** A request with this generator. */
export interface TerrainChild {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "terrain";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: TerrainParameters;
}

/** A request with this generator. */
export interface TreeChild {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "tree";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: TreeParameters;
}

/** A request with this generator. */
export interface WorldChild {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "world";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: WorldParameters;
}

/** A preset, and the changes to it as a JSON Merge Patch (RFC 7396). */
export interface PresetChild {
  generator?: undefined;
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: { [key: string]: unknown };
}

export type Child = BuildingChild | CityChild | FractalChild | LsystemChild | SceneChild | TerrainChild | TreeChild | WorldChild | PresetChild;

/** A request with this generator. */
export interface BuildingRequest {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "building";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: BuildingParameters;
  /** The form of the response. */
  output?: Output;
}

/** A request with this generator. */
export interface CityRequest {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "city";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: CityParameters;
  /** The form of the response. */
  output?: Output;
}

/** A request with this generator. */
export interface FractalRequest {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "fractal";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: FractalParameters;
  /** The form of the response. */
  output?: Output;
}

/** A request with this generator. */
export interface LsystemRequest {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "lsystem";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: LsystemParameters;
  /** The form of the response. */
  output?: Output;
}

/** A request with this generator. */
export interface SceneRequest {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "scene";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: SceneParameters;
  /** The form of the response. */
  output?: Output;
}

/** A request with this generator. */
export interface TerrainRequest {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "terrain";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: TerrainParameters;
  /** The form of the response. */
  output?: Output;
}

/** A request with this generator. */
export interface TreeRequest {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "tree";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: TreeParameters;
  /** The form of the response. */
  output?: Output;
}

/** A request with this generator. */
export interface WorldRequest {
  /** The kind of model. Required unless a preset is given, which then determines it. */
  generator: "world";
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset?: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: WorldParameters;
  /** The form of the response. */
  output?: Output;
}

/** A preset, and the changes to it as a JSON Merge Patch (RFC 7396). */
export interface PresetRequest {
  generator?: undefined;
  /** The name of a shipped request. The rest of this request is merged over it as a JSON Merge Patch (RFC 7396): objects member by member, null removes a member, anything else replaces. */
  preset: string;
  /** The seed: the same request with the same seed gives the same bytes. */
  seed?: Seed;
  /** The parameters of the generator, by the generator's own schema. */
  parameters?: { [key: string]: unknown };
  /** The form of the response. */
  output?: Output;
}

export type Request = BuildingRequest | CityRequest | FractalRequest | LsystemRequest | SceneRequest | TerrainRequest | TreeRequest | WorldRequest | PresetRequest;

export interface PresetListGeneratorsItem {
  name: string;
  title: string;
}

export interface PresetListPresetsItem {
  name: string;
  generator: string;
  title: string;
  description: string;
  tags: string[];
}

export interface PresetList {
  generators: PresetListGeneratorsItem[];
  presets: PresetListPresetsItem[];
}

export interface WarningsItem {
  pointer: string;
  message: string;
  line?: number;
  column?: number;
}

export interface ValidationEstimate2 {
  triangles: number;
  bytes: number;
  exact: boolean;
}

export interface Validation {
  valid: true;
  warnings: WarningsItem[];
  /** Null if the size cannot be computed cheaply. `exact` is true if the model has exactly `triangles`; `bytes` is always an approximation. */
  estimate: null | ValidationEstimate2;
}

export interface ImportedWarningsItem {
  pointer: string;
  message: string;
  line?: number;
  column?: number;
}

export interface Imported {
  /** The detected format. */
  format: "arbaro" | "cpfg" | "ez_tree" | "fractint" | "geojson" | "houdini" | "osm" | "proctree" | "shapeml" | "tree_gen";
  request: Request;
  /** Content of the file without a counterpart in a request, and warnings about the request. The position is a line and column of a text or a pointer into a JSON file. */
  warnings: ImportedWarningsItem[];
}

export interface LsystemDerivationTurtleBounds {
  min?: [number, number, number];
  max?: [number, number, number];
}

export interface LsystemDerivationTurtle {
  segments?: number;
  total_length?: number;
  position?: [number, number, number];
  heading?: [number, number, number];
  left?: [number, number, number];
  up?: [number, number, number];
  bounds?: LsystemDerivationTurtleBounds;
}

export interface LsystemDerivation {
  iterations: number;
  /** The number of modules, brackets and turtle symbols included; exact even if the string is cut. */
  length: number;
  /** How often each symbol occurs. */
  counts: { [key: string]: number };
  string: string;
  /** True if the string has more than 16 MiB and is therefore cut. */
  truncated: boolean;
  turtle: LsystemDerivationTurtle;
  warnings: WarningsItem[];
}

export interface BuildingDerivationShapesItemScope {
  origin: [number, number, number];
  axes: [[number, number, number], [number, number, number], [number, number, number]];
  size: [number, number, number];
}

export interface BuildingDerivationShapesItem {
  id: number;
  parent: number | null;
  symbol: string;
  parameters: (number | string | boolean | unknown[])[];
  /** Whether the shape is part of the result. */
  active: boolean;
  /** The first line of the rule that replaced the shape; shapes that no rule replaced have none. */
  rule?: string;
  /** The line at which that rule begins. */
  line?: number;
  /** The number of the choice, if the rule has several. */
  choice?: number;
  scope: BuildingDerivationShapesItemScope;
}

export interface BuildingDerivationReportsValue {
  count?: number;
  sum?: number;
  mean?: number;
  min?: number;
  max?: number;
}

export interface BuildingDerivation {
  /** The tree of shapes, parents before children; at most 100,000. */
  shapes: BuildingDerivationShapesItem[];
  /** The number of all shapes. */
  count: number;
  /** True if not all shapes are listed. */
  truncated: boolean;
  /** The reports of the rules, by key. */
  reports: { [key: string]: BuildingDerivationReportsValue };
  warnings: WarningsItem[];
}

export type Warnings = WarningsItem[];

export interface Box {
  min: [number, number, number];
  max: [number, number, number];
}

export interface TreeDerivationLevelsItem {
  count: number;
  length: number;
  radius: number;
}

export interface TreeDerivation {
  limbs: number;
  /** The trunk, its branches, their branches, and so on: number, mean length and mean radius at the base, in metres. */
  levels: TreeDerivationLevelsItem[];
  leaves: number;
  height: number;
  bounds: Box;
  warnings: WarningsItem[];
}

export type CityDerivation = { [key: string]: unknown };

/** Levels, extent and origin of the world, and the height of its sea. */
export interface WorldDerivation {
  levels: number;
  extent: number;
  origin: number[];
  sea_level: number | null;
  warnings: WarningsItem[];
}

/** Rows from the south, columns from the west, both borders included. */
export interface WorldMapHeights {
  columns?: number;
  rows?: number;
  values?: number[];
}

export interface WorldMapSettlementsItem {
  id?: string;
  position?: [number, number, number];
  radius?: number;
}

export interface WorldMapRiversItem {
  id?: string;
  into?: string;
  points?: ([number, number, number])[];
  widths?: number[];
}

export interface WorldMapLakesItem {
  id?: string;
  level?: number;
  outline?: number[][];
}

export interface WorldMapRoadsItem {
  id?: string;
  width?: number;
  points?: ([number, number, number])[];
}

export interface WorldMapPlantsItem {
  class?: string;
  spacing?: number;
  count?: number;
  places?: ([number, number, number])[];
}

/** What touches a box of a world. Positions are [east, north, height] in metres from the middle of the world; sea_level is null where there is no sea. */
export interface WorldMap {
  /** west, south, east, north */
  box: [number, number, number, number];
  sea_level: number | null;
  /** Rows from the south, columns from the west, both borders included. */
  heights?: WorldMapHeights;
  settlements: WorldMapSettlementsItem[];
  /** From source to mouth, whole; `into` is `sea` or the id of a lake or river. A width for each point. */
  rivers: WorldMapRiversItem[];
  lakes: WorldMapLakesItem[];
  roads: WorldMapRoadsItem[];
  /** By class; `places` for boxes of at most 2,048 m a side. `spacing` is the least distance within the class. */
  plants: WorldMapPlantsItem[];
}

export type WorldPosition = [number, number, number];

/** The measures of the fractal, in the frame of the unit element. Values that do not apply, are unknown, or are too large for a number are null. */
export interface FractalDerivation {
  pieces: number | null;
  /** Pieces that are below the parameter smallest, and therefore points. */
  points: number | null;
  dimension: number | null;
  exposed_quads: number | null;
  surface_area: number | null;
  volume: number | null;
  genus: number | null;
  non_manifold_edges: number | null;
  /** The length of all copies of a segment, or of the outline of a plate. */
  length: number | null;
  /** The area of one side of a plate. */
  area: number | null;
  /** The same values for each of the stages, with its iterations or points. */
  stages: { [key: string]: unknown }[];
  bounds: Box | null;
  warnings: WarningsItem[];
}

export interface TerrainDerivation {
  /** Samples from west to east; null on a sphere. */
  width: number | null;
  /** Samples from north to south; null on a sphere. */
  height: number | null;
  min: number;
  max: number;
  mean?: number;
  samples?: number;
  /** In metres, row by row from the north-west; null beyond 257 x 257 samples. */
  heights: number[] | null;
  /** Values to enter in an engine when it imports the height map. */
  engines?: { [key: string]: unknown } | null;
  warnings: WarningsItem[];
}

export interface SceneDerivationPlacementsItem {
  /** A name in models. */
  model: string;
  translation: [number, number, number];
  /** A quaternion: x, y, z, w. */
  rotation: [number, number, number, number];
  scale: [number, number, number];
}

export interface SceneDerivationLayersItem {
  name: string;
  placed: number;
}

export interface SceneDerivation {
  placements: SceneDerivationPlacementsItem[];
  /** The request of each model, by name. */
  models: { [key: string]: { [key: string]: unknown } };
  /** The number of models in each layer. */
  layers: SceneDerivationLayersItem[];
  warnings: WarningsItem[];
}
