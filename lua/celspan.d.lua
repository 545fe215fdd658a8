---@meta celspan
--- Annotations of celspan for editors with the Lua language server. Film coordinates start at the
--- top left, x to the right, y down. In every list, later is nearer the camera. Angles are degrees,
--- clockwise. Colours are linear light, but strings are sRGB. It is one file because editors load a
--- library as a whole.

---@alias celspan.colour celspan.paint|string A paint, or "#rgb", "#rgba", "#rrggbb", "#rrggbbaa" (sRGB-coded)
---@alias celspan.surface celspan.colour|celspan.texture The texture of a primitive
---@alias celspan.light number[]|string|celspan.paint|celspan.texture|celspan.light_shape {r, g, b}, {r, g, b, a} or "#rrggbb"; an omitted a is 1; or a light with a shape
---@alias celspan.shape celspan.object|celspan.rostrum A part of a cel or a boolean: an object, or a rostrum with a size
---@alias celspan.point number[] {x, y}
---@alias celspan.rule "nonzero"|"evenodd" How self-crossing outlines are filled
---@alias celspan.mode "normal"|"multiply"|"screen"|"overlay"|"darken"|"lighten"|"color-dodge"|"color-burn"|"hard-light"|"soft-light"|"difference"|"exclusion"|"hue"|"saturation"|"color"|"luminosity"|"add"|"linear-dodge"|"soft-light-photoshop"|"linear-burn"|"vivid-light"|"linear-light"|"pin-light"|"hard-mix"|"subtract"|"divide"|"darker-color"|"lighter-color" How a source is combined with its backdrop
---@alias celspan.antialias "area"|"none"|celspan.filter The exact mean over each pixel, pixel centres, or a kernel
---@alias celspan.exposures celspan.rostrum|table[] A rostrum, or {{rostrum, weight}, ...}: light adds

---@class celspan
---@field _VERSION string "celspan 0.1.0"
---@field clear celspan.paint Nothing at all: light passes unchanged
local celspan = {}

--- Declares the parameters of a film, once, and returns their values. Each name has its default: a
--- string, a number, a boolean, a list of strings of which one is chosen, { colour = "#f26419" },
--- { file = "a.wav" }, a point { 120, 80, point = true }, a curve { ease = "outBack" }, or
--- { default, min =, max =, about =, group = }. `--set` and `--set-from` give other values.
---@param parameters table<string, any>
---@return table<string, any> values
function celspan.parameters(parameters) end

--- The text of a file, of at most 256 MiB. Modules read tables (csv), JSON (json) and captions.
---@param path string Relative to the caller's file, else to the script
---@return string? text
---@return string? message
function celspan.read(path) end

--- Objects side by side by their bounds, from 0, 0 to the right. nil and false take no room.
---@param list { [integer]: celspan.shape, gap?: number, align?: "top"|"centre"|"bottom" }
---@return celspan.object
function celspan.row(list) end

--- Objects below one another, from 0, 0 down.
---@param list { [integer]: celspan.shape, gap?: number, align?: "left"|"centre"|"right" }
---@return celspan.object
function celspan.column(list) end

--- Objects in rows of `columns`, each in the middle of its cell, from 0, 0.
---@param list { [integer]: celspan.shape, columns: integer, gap?: number }
---@return celspan.object
function celspan.grid(list) end

--- An object moved so that its bounds lie in a box, in the middle or at a side.
---@param object celspan.shape
---@param box number[] {x, y, w, h}
---@param horizontal? "left"|"centre"|"right" Default "centre"
---@param vertical? "top"|"centre"|"bottom" Default "centre"
---@return celspan.object
function celspan.align(object, box, horizontal, vertical) end

--- Scales an object until its bounds just lie in a box, and aligns it there.
---@param object celspan.shape
---@param box number[] {x, y, w, h}
---@param horizontal? "left"|"centre"|"right" Default "centre"
---@param vertical? "top"|"centre"|"bottom" Default "centre"
---@param most? number The greatest factor; 1 only makes smaller. Default: none
---@return celspan.object
function celspan.fit(object, box, horizontal, vertical, most) end

--- The object between two others. Outlines are matched by length and turning, parts by name and in
--- order; at 0 and 1 it is the one and the other.
---@param a celspan.object
---@param b celspan.object
---@param u number Limited to 0..1
---@param options? { pairs?: table[] } Two places {{x, y}, {x, y}} or two names of parts each
---@return celspan.object
function celspan.morph(a, b, u, options) end

--- A line with a texture along it and a width that changes: x of the texture goes from 0 to 1 along
--- the line, y from -0.5 to 0.5 across it.
---@param options { d: string|celspan.path, width?: number, profile?: "round"|"even"|"ink"|"chisel"|fun(t: number): number, nib?: number, texture?: celspan.surface, from?: number, to?: number, within?: number, pieces?: integer }
---@return celspan.object
function celspan.brush(options) end

--- A number as it is written in a language: "48,250", "48.250", "48 250".
---@param value number
---@param options? { language?: string, decimals?: integer, group?: boolean } Default "en", 0, true
---@return string
function celspan.count(value, options) end

--- The number of a frame as hours, minutes, seconds and frames: "01:00:04:12".
---@param index integer From 0
---@param fps number
---@param options? { drop?: boolean } Of 29.97 and 59.94 frames a second: right by the clock
---@return string
function celspan.timecode(index, fps, options) end

--- The pictures of a movie, or of numbered files, by their times.
---@class celspan.footage
---@field size number[] {w, h}, upright, with square pixels
---@field fps number
---@field frames integer
---@field seconds number
---@field sound boolean
local footage = {}

--- The picture that is shown at a time.
---@param seconds number
---@return celspan.texture
function footage:at(seconds) end

--- The picture with this number.
---@param number integer From 1
---@return celspan.texture
function footage:frame(number) end

--- Opens a movie, or numbered files such as "plate.####.exr".
---@param options { file: string, from?: number, to?: number, speed?: number, loop?: boolean, fps?: number, alpha?: "straight"|"premultiplied", colour?: string, layer?: string }
---@return celspan.footage
function celspan.footage(options) end

--- An object with its earlier moments, fainter, behind it.
---@param draw fun(k: integer): celspan.object? The object k steps ago; nil: nothing
---@param options? { count?: integer, fade?: number } Default 5, 0.7
---@return celspan.object
function celspan.echo(draw, options) end

--- The part of every contour between two shares of its length.
---@param object celspan.shape
---@param from number
---@param to number
---@param options? { offset?: number, together?: boolean }
---@return celspan.object
function celspan.trim(object, from, to, options) end

--- The object grown, or with a distance below 0 shrunk.
---@param object celspan.shape
---@param distance number
---@param options? { join?: "round"|"miter"|"bevel", limit?: number } Default "round", 4
---@return celspan.object
function celspan.offset(object, distance, options) end

--- Arcs in place of the corners between straight sides.
---@param object celspan.shape
---@param radius number Of an arc in a right angle
---@return celspan.object
function celspan.round_corners(object, radius) end

--- Points at a distance from every piece of a contour, on its two sides in turn.
---@param object celspan.shape
---@param options { size: number, ridges: integer, smooth?: boolean } ridges: of each piece
---@return celspan.object
function celspan.zigzag(object, options) end

--- Bloats (above 0) or puckers (below 0): joints move towards their middle, control points away.
---@param object celspan.shape
---@param amount number -1..1
---@return celspan.object
function celspan.pucker(object, amount) end

--- Points turn about a centre, the less the farther they are from it.
---@param object celspan.shape
---@param degrees number At the centre
---@param options? { centre?: celspan.point } Default: the middle of the bounds
---@return celspan.object
function celspan.twist(object, degrees, options) end

--- Copies of an object, each moved, turned, scaled and faded further.
---@param object celspan.shape
---@param options { count: integer, offset?: number, translate?: celspan.point, rotate?: number, scale?: number|number[], centre?: celspan.point, opacity?: number[], order?: "above"|"below", each?: fun(copy: celspan.object, i: integer): celspan.object? }
---@return celspan.object
function celspan.repeater(object, options) end

--- Objects as one shape, with the texture of the first unless another is given.
---@param objects celspan.shape[]
---@param options? { mode?: "merge"|"add"|"subtract"|"intersect"|"exclude", texture?: celspan.surface }
---@return celspan.object
function celspan.merge(objects, options) end

--- Two objects by an operator of Porter and Duff.
---@param a celspan.shape The source, in front
---@param b celspan.shape The backdrop
---@param operator "over"|"in"|"out"|"atop"|"xor"
---@return celspan.object
function celspan.composite(a, b, operator) end

--- An object of which the alpha decides by chance whether a pixel of the film is opaque or clear.
---@param object celspan.shape
---@param seed? integer Another one chooses other pixels (0)
---@return celspan.object
function celspan.dissolve(object, seed) end

--- A star, or without `inner` a regular polygon.
---@param options { centre?: celspan.point, points?: integer, outer: number, inner?: number, rotate?: number, outer_round?: number, inner_round?: number, texture?: celspan.surface }
---@return celspan.object
function celspan.star(options) end

--- The bounds of an object with a margin, as a box {x, y, w, h}.
---@param object celspan.shape
---@param margin? number|number[] On all sides, or {across, down}
---@return number[] box
function celspan.around(object, margin) end

--- A text whose letters, words or lines a function changes: it returns an object, or nil for
--- nothing. With `along`, path data or a path, the text runs along it; a letter then has `degrees`.
---@param text celspan.text.fields
---@param change? fun(letter: celspan.letter, i: integer, n: integer): celspan.object?
---@param options? { by?: "letter"|"word"|"line", along?: string|celspan.shape, start?: number }
---@return celspan.object
function celspan.letters(text, change, options) end

--- A value that can have a name. Transforms, fades and `with` keep the name.
---@class celspan.nameable
---@field name? string
---@field origin? string The line that made it, "shot.lua:12"
---@operator len: integer
local nameable = {}

--- The same value with a name, which messages use: 1 to 255 bytes without control characters.
---@generic T: celspan.nameable
---@param self T
---@param name string
---@return T
function nameable:named(name) end

---@class celspan.paint.fields
---@field pigment? number[]|string {r, g, b} or "#rrggbb"; default black
---@field medium? number[]|string {r, g, b} or "#rrggbb"; default white, which is clear
---@field beta? number The share of the pigment; 0 to 1; default 1

---@class celspan.paint: celspan.nameable, celspan.paint.fields
---@field pigment number[]
---@field medium number[]
---@field beta number
local paint = {}

--- A paint of the Beta colour model: `pigment` scatters the front light, `medium` filters the light
--- from behind, `beta` is the share of the pigment. All values are straight, 0..1.
---@param fields celspan.paint.fields
---@return celspan.paint
function celspan.paint(fields) end

--- A copy with changes.
---@param changes celspan.paint.fields
---@return celspan.paint
function paint:with(changes) end

--- A pigment over a clear medium.
---@param r number
---@param g number
---@param b number
---@param alpha? number Default 1
---@return celspan.paint
---@overload fun(colour: string, alpha?: number): celspan.paint
function celspan.rgb(r, g, b, alpha) end

--- A pure filter, like a coloured gel: it is only visible in light from behind.
---@param r number
---@param g number
---@param b number
---@param alpha? number Default 1; less mixes it with clear
---@return celspan.paint
---@overload fun(colour: string, alpha?: number): celspan.paint
function celspan.gel(r, g, b, alpha) end

--- (1-u) p + u q, premultiplied.
---@param p celspan.colour
---@param q celspan.colour
---@param u number 0..1
---@return celspan.paint
function celspan.mix(p, q, u) end

--- A gradient, noise or a picture, in the units of its primitive; it moves with the primitive.
---@class celspan.texture: celspan.nameable
local texture = {}

--- A copy with changes.
---@param changes table
---@return celspan.texture
function texture:with(changes) end

---@class celspan.gradient.fields
---@field [integer] table Three corners {x, y, paint}

---@class celspan.gradient: celspan.texture, celspan.gradient.fields

--- The triangle gradient; it continues outside the triangle.
---@param fields celspan.gradient.fields
---@return celspan.gradient
function celspan.gradient(fields) end

---@class celspan.linear.fields
---@field [integer] table Stops {at, paint}, at ascending in 0..1
---@field from celspan.point Where 0 lies
---@field to celspan.point Where 1 lies
---@field spread? "hold"|"repeat"|"reflect" The values before 0 and after 1; default "hold"
---@field matrix? number[] Nine numbers: moves the gradient alone

---@class celspan.linear: celspan.texture, celspan.linear.fields

--- A gradient along a line; beyond the ends it holds or repeats.
---@param fields celspan.linear.fields
---@return celspan.linear
function celspan.linear(fields) end

---@class celspan.radial.fields
---@field [integer] table Stops {at, paint}, at ascending in 0..1
---@field centre celspan.point
---@field radius number Of the circle where 1 lies; 0 or more
---@field focus? celspan.point Where 0 lies; default the centre
---@field spread? "hold"|"repeat"|"reflect" The values before 0 and after 1; default "hold"
---@field matrix? number[] Nine numbers: moves the gradient alone

---@class celspan.radial: celspan.texture, celspan.radial.fields

--- A gradient around a point; outside the circle it holds or repeats.
---@param fields celspan.radial.fields
---@return celspan.radial
function celspan.radial(fields) end

---@class celspan.conic.fields
---@field [integer] table Stops {at, paint}, at ascending in 0..1
---@field centre celspan.point
---@field angle? number Where 0 lies, in degrees clockwise from up; default 0
---@field matrix? number[] Nine numbers: moves the gradient alone

---@class celspan.conic: celspan.texture, celspan.conic.fields
---@field angle number

--- A gradient once round a point, clockwise.
---@param fields celspan.conic.fields
---@return celspan.conic
function celspan.conic(fields) end

---@class celspan.noise.fields
---@field kind? "perlin"|"value"|"fractal"|"turbulence"|"cells"|"white" One octave of hills, of values, of cells or of squares; or the sum of several; default "perlin"
---@field size? number The side of a cell of the first octave; more than 0; default 100
---@field octaves? integer Of fractal and turbulence: each has half the size of the last; 1 to 16; default 4
---@field gain? number Of fractal and turbulence: an octave's height, as a share of that before; 0 to 1; default 0.5
---@field seed? integer Another number is another noise; -2.147484e9 to 2.147484e9; default 0
---@field at? number The third dimension, in cells: change it to let the noise move; default 0
---@field fade? boolean Whether octaves finer than pixels fade out; default "true"
---@field colours? celspan.colour[] Two or more, from 0 to 1 at even distances; default { "#000", "#fff" }
---@field matrix? number[] Nine numbers: moves the noise alone

---@class celspan.noise: celspan.texture, celspan.noise.fields
---@field kind "perlin"|"value"|"fractal"|"turbulence"|"cells"|"white"
---@field size number
---@field seed integer
---@field at number
---@field fade boolean

--- Random hills, clouds or cells, without end.
---@param fields celspan.noise.fields
---@return celspan.noise
function celspan.noise(fields) end

---@class celspan.picture.fields
---@field box? number[] {x, y, w, h}; default the bounding rectangle of the primitive
---@field file? string Relative to the script; required unless `pixels` is given
---@field frame? integer The number in the name of the file, where the name has #### or %04d
---@field colour? string "srgb", "linear", "rec709" or "cineon"; default by the file
---@field sampling? "auto"|"nearest"|"bilinear"|"bicubic" Default "auto"
---@field as? "paint"|"gel" Paint, or a slide lit from behind; default "paint"
---@field wrap? "clear"|"clamp"|"repeat" Outside the box; default "clear"
---@field subimage? integer From 0; default 0
---@field layer? string The name of a subimage
---@field source? integer[] {x, y, w, h}; a part of the picture, in its pixels
---@field smooth? boolean Alpha of 8 bits without steps, for painted glows
---@field pixels? string Pixels in memory, rows from top to bottom without gaps
---@field size? integer[] {w, h}; of the pixels; 1 to 1048576
---@field format? "rgba8"|"rgb8"|"grey8"|"rgba16"|"rgbaf" Of the pixels, in the machine's byte order; default "rgba8"
---@field alpha? "straight"|"premultiplied" Of the pixels; default integers straight, floats premultiplied

---@class celspan.picture: celspan.texture, celspan.picture.fields
---@field sampling "auto"|"nearest"|"bilinear"|"bicubic"
---@field as "paint"|"gel"
---@field wrap "clear"|"clamp"|"repeat"

--- A picture as a texture: a file, read when it is first visible, or pixels in memory.
---@param fields celspan.picture.fields
---@return celspan.picture
function celspan.picture(fields) end

---@class celspan.pattern.fields
---@field art celspan.object What is repeated
---@field box number[] {x, y, w, h}; the part of the art that is repeated, in its units
---@field matrix? number[] Nine numbers: moves the pattern alone

---@class celspan.pattern: celspan.texture, celspan.pattern.fields

--- Art that is repeated over the plane, as a texture of primitives.
---@param fields celspan.pattern.fields
---@return celspan.pattern
function celspan.pattern(fields) end

--- The methods of objects and cels. Each method returns a new value.
---@class celspan.placed: celspan.nameable
---@field mode celspan.mode
local placed = {}

--- Moves it.
---@generic T: celspan.placed
---@param self T
---@param dx number
---@param dy number
---@return T
function placed:translate(dx, dy) end

--- Enlarges it, about the origin or a fixed centre.
---@generic T: celspan.placed
---@param self T
---@param sx number
---@param sy? number Default sx
---@param cx? number
---@param cy? number
---@return T
function placed:scale(sx, sy, cx, cy) end

--- Turns clockwise on screen, about the origin or a centre.
---@generic T: celspan.placed
---@param self T
---@param degrees number
---@param cx? number
---@param cy? number
---@return T
function placed:rotate(degrees, cx, cy) end

--- Slants it, about the origin or a centre.
---@generic T: celspan.placed
---@param self T
---@param degrees_x number
---@param degrees_y number
---@param cx? number
---@param cy? number
---@return T
function placed:skew(degrees_x, degrees_y, cx, cy) end

--- A 3x3 matrix row by row, for column vectors.
---@generic T: celspan.placed
---@param self T
---@param matrix number[] Nine numbers
---@return T
function placed:transform(matrix) end

--- The perspective that maps the first four points to the second.
---@generic T: celspan.placed
---@param self T
---@param from celspan.point[]
---@param to celspan.point[]
---@return T
function placed:quad(from, to) end

--- The paint mixed with clear: 1 leaves it unchanged, 0 makes it invisible.
---@generic T: celspan.placed
---@param self T
---@param k number 0..1
---@return T
function placed:fade(k) end

--- With a blend mode: how it is combined with its backdrop. `mode` reads it.
---@generic T: celspan.placed
---@param self T
---@param mode celspan.mode
---@return T
function placed:blend(mode) end

--- With a soft shadow behind it, or inside.
---@generic T: celspan.placed
---@param self T
---@param options? celspan.shadow.options
---@return T
function placed:shadow(options) end

--- With its shape, blurred, added as light behind it.
---@generic T: celspan.placed
---@param self T
---@param options celspan.glow.options
---@return T
function placed:glow(options) end

--- With its shape, grown by a width, behind it.
---@generic T: celspan.placed
---@param self T
---@param options celspan.outline.options
---@return T
function placed:outline(options) end

--- The smallest axis-aligned rectangle around it; returns nothing if there is nothing to paint.
---@return number? x, number? y, number? width, number? height
function placed:bounds() end

--- Whether a point is inside the shape, whatever its paint.
---@param x number
---@param y number
---@return boolean
function placed:contains(x, y) end

--- A copy with changes; transforms and fades are kept.
---@generic T: celspan.placed
---@param self T
---@param changes table
---@return T
function placed:with(changes) end

--- A primitive or a boolean tree of them.
---@class celspan.object: celspan.placed
---@operator bor(celspan.object): celspan.boolean
---@operator band(celspan.object): celspan.boolean
---@operator bxor(celspan.object): celspan.boolean
---@operator sub(celspan.object): celspan.boolean
local object = {}

--- The stroke of a primitive's outline, with the primitive's transform and fade.
---@param style? celspan.stroke.style
---@return celspan.stroke
function object:stroke(style) end

--- How an object is bent: one of map, along, lattice, bones and pins is given.
---@class celspan.warp.options
---@field map? fun(x: number, y: number): number, number
---@field along? string|celspan.path Path data or a path
---@field start? number With `along`: a share of its length. Default 0
---@field stretch? boolean With `along`: to the rest of its length
---@field lattice? { columns?: integer, rows?: integer, points: celspan.point[], smooth?: boolean, box?: number[] }
---@field bones? celspan.warp.bone[]
---@field pins? { from: celspan.point, to?: celspan.point }[]
---@field within? number How far outlines may lie from their place
---@field pieces? integer The most triangles of a picture. Default 400

---@class celspan.warp.bone
---@field [1]? string Its name
---@field from celspan.point
---@field to celspan.point
---@field rotate? number Degrees, relative to its parent
---@field scale? number Along the bone
---@field at? celspan.point Where `from` comes to lie
---@field parent? integer|string|false An earlier bone; default: the one before it
---@field radius? number How far it has influence; default: a quarter of its length

--- Bent by a map of the plane: outlines stay curves, pictures become meshes.
---@param options celspan.warp.options
---@return celspan.object
function object:warp(options) end

--- Lines that wobble, as if each drawing were traced again; what touches stays together.
---@param options { amount: number, frame: integer, every?: integer, seed?: integer|string, grain?: number, within?: number, pieces?: integer }
---@return celspan.object
function object:boil(options) end

--- Shows at each point p what lies at p + scale (code - 0.5), by the codes of another object at p.
---@param options celspan.displace.options
---@return celspan.object
function object:displace(options) end

--- Out of focus, or blurred along a line, rays or arcs. The radius is in its units and follows its
--- transforms.
---@param radius number
---@param options? celspan.blur.options
---@return celspan.object
function object:blur(radius, options) end

--- With more contrast between its points and those around them; its shape does not change.
---@param options? celspan.sharpen.options
---@return celspan.object
function object:sharpen(options) end

--- The whole shape in one texture, which is in the units around it, with its fade and its name.
---@param texture celspan.texture|celspan.paint|string
---@return celspan.object
function object:paint(texture) end

---@class celspan.rect.fields
---@field [integer] number x, y, width, height
---@field radius? number|number[] Of all corners, or {top left, top right, bottom right, bottom left}; default 0
---@field texture? celspan.surface Default "#000000"

---@class celspan.rect: celspan.object, celspan.rect.fields
---@field radius number|number[]
---@field texture celspan.surface

--- A rectangle.
---@param fields celspan.rect.fields
---@return celspan.rect
function celspan.rect(fields) end

---@class celspan.triangle.fields
---@field [integer] celspan.point Three points
---@field texture? celspan.surface Default "#000000"

---@class celspan.triangle: celspan.object, celspan.triangle.fields
---@field texture celspan.surface

--- A triangle.
---@param fields celspan.triangle.fields
---@return celspan.triangle
function celspan.triangle(fields) end

---@class celspan.circle.fields
---@field centre celspan.point
---@field radius number 0 or more
---@field texture? celspan.surface Default "#000000"

---@class celspan.circle: celspan.object, celspan.circle.fields
---@field texture celspan.surface

--- A circle.
---@param fields celspan.circle.fields
---@return celspan.circle
function celspan.circle(fields) end

---@class celspan.ellipse.fields
---@field centre celspan.point
---@field radii number[] {rx, ry}
---@field texture? celspan.surface Default "#000000"

---@class celspan.ellipse: celspan.object, celspan.ellipse.fields
---@field texture celspan.surface

--- An ellipse.
---@param fields celspan.ellipse.fields
---@return celspan.ellipse
function celspan.ellipse(fields) end

---@class celspan.polygon.fields
---@field [integer] celspan.point
---@field rule? celspan.rule Default "nonzero"
---@field texture? celspan.surface Default "#000000"

---@class celspan.polygon: celspan.object, celspan.polygon.fields
---@field rule celspan.rule
---@field texture celspan.surface

--- A closed polygon.
---@param fields celspan.polygon.fields
---@return celspan.polygon
function celspan.polygon(fields) end

---@class celspan.nurbs.fields
---@field points number[][] {x, y} or {x, y, weight}; the point itself, not multiplied by its weight
---@field degree? integer 1 to 15; default 3
---@field knots? number[] Default uniform
---@field closed? "periodic"|"clamped" Default "periodic"
---@field rule? celspan.rule Default "nonzero"
---@field texture? celspan.surface Default "#000000"

---@class celspan.nurbs: celspan.object, celspan.nurbs.fields
---@field degree integer
---@field closed "periodic"|"clamped"
---@field rule celspan.rule
---@field texture celspan.surface

--- A closed curve of any degree, with or without weights.
---@param fields celspan.nurbs.fields
---@return celspan.nurbs
function celspan.nurbs(fields) end

---@class celspan.path.fields
---@field d string SVG path data; open subpaths are closed
---@field rule? celspan.rule Default "nonzero"
---@field texture? celspan.surface Default "#000000"

---@class celspan.path: celspan.object, celspan.path.fields
---@field rule celspan.rule
---@field texture celspan.surface

--- The area inside lines, curves and arcs.
---@param fields celspan.path.fields
---@return celspan.path
function celspan.path(fields) end

---@class celspan.stroke.style
---@field width? number For points without their own; 0 or more; default 1
---@field cap? "butt"|"round"|"square" Default "butt"
---@field join? "miter"|"round"|"bevel" Default "miter"
---@field miter? number The longest miter, in widths; 1 to 1000000; default 4
---@field dash? number[] Lengths drawn and left out in turn
---@field dash_offset? number The distance into the dashes at which each subpath begins; while it grows, dashes move towards the beginning; default 0
---@field taper? number[] {begin, end}: lengths over which the width grows from 0 and falls to 0
---@field profile? "straight"|"round" Of tapers; round: without a corner where the taper ends; default "straight"
---@field from? number Where drawing begins, as a fraction of the whole length; default 0
---@field to? number Where drawing ends; default 1
---@field texture? celspan.surface Default "#000000"

---@class celspan.stroke.fields
---@field points? number[][] {x, y} or {x, y, width}
---@field d? string SVG path data; Z closes a subpath
---@field outline? celspan.object A primitive, in its own units
---@field closed? boolean Whether the line returns to its first point
---@field degree? integer Of the spline through the points; 1 to 15; default 1
---@field width? number For points without their own; 0 or more; default 1
---@field cap? "butt"|"round"|"square" Default "butt"
---@field join? "miter"|"round"|"bevel" Default "miter"
---@field miter? number The longest miter, in widths; 1 to 1000000; default 4
---@field dash? number[] Lengths drawn and left out in turn
---@field dash_offset? number The distance into the dashes at which each subpath begins; while it grows, dashes move towards the beginning; default 0
---@field taper? number[] {begin, end}: lengths over which the width grows from 0 and falls to 0
---@field profile? "straight"|"round" Of tapers; round: without a corner where the taper ends; default "straight"
---@field from? number Where drawing begins, as a fraction of the whole length; default 0
---@field to? number Where drawing ends; default 1
---@field texture? celspan.surface Default "#000000"

---@class celspan.stroke: celspan.object, celspan.stroke.fields
---@field degree integer
---@field width number
---@field cap "butt"|"round"|"square"
---@field join "miter"|"round"|"bevel"
---@field miter number
---@field dash_offset number
---@field profile "straight"|"round"
---@field from number
---@field to number
---@field texture celspan.surface

--- A line with a width. Give exactly one of points, d and outline.
---@param fields celspan.stroke.fields
---@return celspan.stroke
function celspan.stroke(fields) end

---@class celspan.image.fields
---@field x? number Default 0
---@field y? number Default 0
---@field w? number If only one of w and h is given, the aspect ratio is kept; 0 or more; default the width of the picture
---@field h? number 0 or more
---@field fit? "fill"|"contain"|"cover" If both w and h are given; default "fill"
---@field file? string Relative to the script; required unless `pixels` is given
---@field frame? integer The number in the name of the file, where the name has #### or %04d
---@field colour? string "srgb", "linear", "rec709" or "cineon"; default by the file
---@field sampling? "auto"|"nearest"|"bilinear"|"bicubic" Default "auto"
---@field as? "paint"|"gel" Paint, or a slide lit from behind; default "paint"
---@field wrap? "clear"|"clamp"|"repeat" Outside the box; default "clear"
---@field subimage? integer From 0; default 0
---@field layer? string The name of a subimage
---@field source? integer[] {x, y, w, h}; a part of the picture, in its pixels
---@field smooth? boolean Alpha of 8 bits without steps, for painted glows
---@field pixels? string Pixels in memory, rows from top to bottom without gaps
---@field size? integer[] {w, h}; of the pixels; 1 to 1048576
---@field format? "rgba8"|"rgb8"|"grey8"|"rgba16"|"rgbaf" Of the pixels, in the machine's byte order; default "rgba8"
---@field alpha? "straight"|"premultiplied" Of the pixels; default integers straight, floats premultiplied

---@class celspan.image: celspan.object, celspan.image.fields
---@field x number
---@field y number
---@field fit "fill"|"contain"|"cover"
---@field sampling "auto"|"nearest"|"bilinear"|"bicubic"
---@field as "paint"|"gel"
---@field wrap "clear"|"clamp"|"repeat"

--- A rectangle textured with a picture.
---@param fields celspan.image.fields
---@return celspan.image
function celspan.image(fields) end

---@class celspan.text.metrics
---@field ascent number Of a line of the first font, above the baseline
---@field descent number Below it
---@field cap_height number Of capitals
---@field x_height number Of small letters without ascenders
---@field width number Of the widest line
---@field height number From the ascent of the first line to the descent of the last one
---@field lines integer

---@class celspan.text.fields
---@field [integer] string|number The text; \n breaks lines
---@field font string|string[] Files; each letter is taken from the first font that has it
---@field size? number The em; 0 or more; default 48
---@field at? celspan.point The baseline of the first line; default {0, 0}
---@field align? "left"|"centre"|"right" The same in every script; default "left"
---@field valign? "baseline"|"top"|"cap"|"middle"|"bottom" What of the text lies at at[2]; default "baseline"
---@field width? number Lines wrap, and align within at[1] .. at[1] + width; 0 or more
---@field leading? number From baseline to baseline, times size; default 1.2
---@field tracking? number Thousandths of an em after each letter; default 0
---@field features? table<string, boolean|integer> OpenType features: { liga = false, ss01 = true, salt = 2 }
---@field variations? table<string, number> Axes of variable fonts: { wght = 700 }
---@field language? string "en", "tr", "zh-Hant"
---@field direction? "auto"|"ltr"|"rtl" Default by the first letter of each line of the text
---@field face? integer The number of the font in a collection (.ttc, .otc); 1 or more; default 1
---@field texture? celspan.surface Default "#000000"

---@class celspan.text: celspan.object, celspan.text.fields
---@field size number
---@field align "left"|"centre"|"right"
---@field valign "baseline"|"top"|"cap"|"middle"|"bottom"
---@field leading number
---@field tracking number
---@field face integer
---@field texture celspan.surface
local text = {}

--- The letters of a text as one primitive.
---@param fields celspan.text.fields
---@return celspan.text
function celspan.text(fields) end

--- The measures of a text in its own units.
---@return celspan.text.metrics
function text:metrics() end

---@class celspan.glyph.fields
---@field [integer] string|number The text; \n breaks lines
---@field index integer From 1
---@field font string|string[] Files; each letter is taken from the first font that has it
---@field size? number The em; 0 or more; default 48
---@field at? celspan.point The baseline of the first line; default {0, 0}
---@field align? "left"|"centre"|"right" The same in every script; default "left"
---@field valign? "baseline"|"top"|"cap"|"middle"|"bottom" What of the text lies at at[2]; default "baseline"
---@field width? number Lines wrap, and align within at[1] .. at[1] + width; 0 or more
---@field leading? number From baseline to baseline, times size; default 1.2
---@field tracking? number Thousandths of an em after each letter; default 0
---@field features? table<string, boolean|integer> OpenType features: { liga = false, ss01 = true, salt = 2 }
---@field variations? table<string, number> Axes of variable fonts: { wght = 700 }
---@field language? string "en", "tr", "zh-Hant"
---@field direction? "auto"|"ltr"|"rtl" Default by the first letter of each line of the text
---@field face? integer The number of the font in a collection (.ttc, .otc); 1 or more; default 1
---@field texture? celspan.surface Default "#000000"

---@class celspan.glyph: celspan.object, celspan.glyph.fields
---@field size number
---@field align "left"|"centre"|"right"
---@field valign "baseline"|"top"|"cap"|"middle"|"bottom"
---@field leading number
---@field tracking number
---@field face integer
---@field texture celspan.surface

--- A letter of celspan.glyphs.
---@class celspan.letter
---@field object celspan.glyph At its place in the text
---@field x number Its left end
---@field y number Its baseline
---@field advance number Its width, without tracking
---@field text string
---@field line integer From 1

--- The letters of a text, each as an object, in reading order.
---@param fields celspan.text.fields
---@return celspan.letter[]
function celspan.glyphs(fields) end

--- A row of pixels, in the units of the primitive.
---@class celspan.scanline.row
---@field x0 number The visible part
---@field x1 number
---@field pixel number The width of a pixel

---@class celspan.scanline.fields
---@field bounds number[] {x, y, w, h}
---@field spans fun(y: number, row: celspan.scanline.row): table[] {x0, x1, paint [, paint]} or {x0, x1, array = {paint, ...}}

---@class celspan.scanline: celspan.object, celspan.scanline.fields

--- A primitive defined by a function that returns its spans on a row.
---@param fields celspan.scanline.fields
---@return celspan.scanline
function celspan.scanline(fields) end

--- The result of the operators and of the functions below.
---@class celspan.boolean: celspan.object
---@field [integer] celspan.shape Its operands

--- Later over earlier; a | b.
---@param objects celspan.shape[]
---@return celspan.boolean
function celspan.union(objects) end

--- The area in all of them, later over earlier; a & b.
---@param objects celspan.shape[]
---@return celspan.boolean
function celspan.intersection(objects) end

--- The first, outside all others; a - b.
---@param objects celspan.shape[]
---@return celspan.boolean
function celspan.difference(objects) end

--- The area in an odd number of them; a ~ b.
---@param objects celspan.shape[]
---@return celspan.boolean
function celspan.xor(objects) end

--- The art inside the shape; the shape's own texture is not painted.
---@param art celspan.shape
---@param shape celspan.shape
---@return celspan.boolean
function celspan.clip(art, shape) end

---@class celspan.group.fields
---@field [integer] celspan.shape
---@field opacity? number Of the group as a whole; limited to 0..1; default 1
---@field blend? celspan.mode How it is combined with its backdrop; default normal
---@field space? "linear"|"srgb" The numbers that are mixed in it: linear light, or sRGB codes; default the space around it
---@field grade? celspan.grade How its colours are changed
---@field isolate? boolean Whether modes inside act only inside; default true if it is faded, has a mode, a grade, or another space than what it is in

---@class celspan.group: celspan.object, celspan.group.fields
---@field opacity number

--- Objects that are composited by themselves, then put into the picture as one.
---@param fields celspan.group.fields
---@return celspan.group
function celspan.group(fields) end

---@class celspan.key.fields
---@field [integer] celspan.shape
---@field colour? celspan.surface Of the screen; not grey; default "#0b0"
---@field tolerance? number Clear where Cb and Cr are as near as this to the colour's; 0 or more; default 0.2
---@field softness? number How much farther away it is whole; 0 or more; default 0.1
---@field spill? number The part of the screen's light in the art that is taken off; 0 to 1; default 1
---@field luma? boolean By brightness, not by hue; default false
---@field from? number The code of luma at which it is clear; default 0
---@field to? number And at which it is whole; default 1

---@class celspan.key: celspan.object, celspan.key.fields

--- An object, clear where it has the colour of a screen.
---@param fields celspan.key.fields
---@return celspan.key
function celspan.key(fields) end

--- How an object is blurred.
---@class celspan.blur.options
---@field radius number As of defocus, in the object's units; 0 to 1000000
---@field kernel? "gaussian"|"box"|"disc"|"pixel" Default "gaussian"
---@field edge? "clear"|"extend" Beyond its bounds: nothing, or what lies on their edge; default "clear"
---@field angle? number Along a line: degrees, clockwise from the right
---@field zoom? celspan.point Along rays from this point; radius: per cent of the distance, at most 90
---@field spin? celspan.point Along arcs about this point; radius: degrees, at most 180

--- How an object is displaced.
---@class celspan.displace.options
---@field by celspan.shape The object whose colours say how far, in the object's units
---@field x? "r"|"g"|"b"|"a" The channel that moves along x; default "r"
---@field y? "r"|"g"|"b"|"a" The channel that moves along y; default "g"
---@field scale? number Units between the points that black and white show; -1000000 to 1000000; default 20
---@field space? "linear"|"srgb" Of the channels: codes, or light; default "srgb"

--- How an object is sharpened.
---@class celspan.sharpen.options
---@field radius? number Of the blur that it is compared with; 0 to 1000; default 2
---@field amount? number How often the difference is added; 0 to 100; default 1

--- What shadow an object has.
---@class celspan.shadow.options
---@field offset? celspan.point How far the shadow is moved; default {0, 0}
---@field blur? number The radius that it is blurred by; 0 to 1000000; default 0
---@field colour? celspan.surface Default "#000000"
---@field opacity? number Limited to 0..1; default 1
---@field inside? boolean Whether it lies within the object, over it; default false
---@field only? boolean Whether the object itself is left out; default false

--- How an object glows.
---@class celspan.glow.options
---@field radius number As of a blur; 0 to 1000000
---@field colour celspan.surface
---@field gain? number What its light is multiplied by; 0 or more; default 1

--- What outline an object has.
---@class celspan.outline.options
---@field width number How far it reaches beyond the shape; 0 to 1000000
---@field texture? celspan.surface Default "#000000"
---@field join? "miter"|"round"|"bevel" At the corners of shapes; default "round"
---@field blur? number The radius that it is blurred by; 0 to 1000000; default 0
---@field opacity? number Limited to 0..1; default 1
---@field only? boolean Whether the object itself is left out; default false

--- How a matte is used.
---@class celspan.matte.options
---@field from? "alpha"|"luma"|"dissolve" What of the matte counts; default "alpha"
---@field invert? boolean The art is present where the matte is not; default false
---@field grow? number Units that the matte grows by; below 0 it is choked; -1000000 to 1000000; default 0
---@field feather? number The radius of its blur; 0 to 1000000; default 0

--- An object that is faded by a matte.
---@class celspan.matte: celspan.boolean, celspan.matte.options

--- The art, present as far as `by` is; `by` is not drawn.
---@param art celspan.shape
---@param by celspan.shape
---@param options? celspan.matte.options
---@return celspan.matte
function celspan.matte(art, by, options) end

--- How far a cel is out of focus.
---@class celspan.defocus
---@field radius number Film units on the frame; 0 or more
---@field kernel? "gaussian"|"box"|"disc"|"pixel" Default "gaussian"
---@field edge? "clear"|"extend" Beyond the frame: the art, or what lies on its edge; default "clear"

--- Grain of a film, a rostrum or a cel.
---@class celspan.grain
---@field amount? number The standard deviation of codes, which are 0 to 1; 0 to 0.3; default 0.05
---@field size? number Of the largest grains, in film units; more than 0; default 1.5
---@field seed? integer Another number is another grain; -2.147484e9 to 2.147484e9; default 0
---@field frame? integer Another one has other grain; -2.147484e9 to 2.147484e9; default the one that is being built

--- Steps that change colours, in this order.
---@class celspan.grade
---@field exposure? number Stops: times 2 to the power of this; -64 to 64; default 0
---@field slope? number[] {r, g, b}; of the ASC CDL: (c slope + offset)^power, held above 0; default {1, 1, 1}
---@field offset? number[] {r, g, b}; default {0, 0, 0}
---@field power? number[] {r, g, b}; 0.0009765625 to 1024; default {1, 1, 1}
---@field contrast? number 0 or more; default 1
---@field pivot? number What contrast leaves as it is; default 0.18, and 0.46 in "srgb"
---@field saturation? number 0 or more; default 1
---@field hue? number Degrees; default 0
---@field temperature? number From blue to orange; -1 to 1; default 0
---@field tint? number From green to magenta; -1 to 1; default 0
---@field gamma? number 0.0009765625 to 1024; default 1
---@field matrix? number[][] 3 rows of 4: red, green, blue by those, and 1
---@field curve? celspan.point[]|celspan.point[][] {in, out}, ..., for all channels or three times: a monotone cubic
---@field steps? integer Levels of each channel's sRGB code; 2 to 256; default none
---@field lut? string The name of a .cube file
---@field lut_space? "linear"|"srgb" What the numbers of the table are: sRGB codes, or light; default "srgb"

---@class celspan.cel.fields
---@field [integer] celspan.shape
---@field front? celspan.light Default that of the rostrum, else white
---@field back? celspan.light Shines through the whole frame from behind this cel; default none
---@field viewport? number[] {x, y, w, h}; the part that fills the frame
---@field defocus? number|celspan.defocus A radius, or with a kernel
---@field blend? celspan.mode How it is combined with its backdrop; default normal
---@field grade? celspan.grade How its colours are changed
---@field grain? celspan.grain Grey grain, another one in each frame
---@field opacity? number Limited to 0..1; default 1

---@class celspan.cel: celspan.placed, celspan.cel.fields
---@field opacity number

--- A sheet with objects and its own lights.
---@param fields celspan.cel.fields
---@return celspan.cel
function celspan.cel(fields) end

--- A light with a shape: gain times beta times pigment at each point.
---@class celspan.light_shape
---@field texture celspan.surface
---@field gain? number 0 or more; default 1
---@field on? "frame"|"cel" In film units on the frame, or in the units of the cel, moving with it; default "frame"
---@field matte? number The matte of a back light is its beta times this; 0 to 1; default 1

---@class celspan.rostrum.fields
---@field [integer] celspan.cel
---@field front? celspan.light For the cels without their own
---@field back? celspan.light Behind the rearmost cel: "#fff" is a white ground
---@field brightness? number Multiplies the light, not alpha; 0 or more; default 1
---@field camera? celspan.camera
---@field antialias? celspan.antialias Default "area"
---@field size? number[] {w, h}; film units: the size of its own film; required for use as an object
---@field grade? celspan.grade How its colours are changed
---@field grain? celspan.grain Grey grain, another one in each frame
---@field space? "linear"|"srgb" The numbers that are mixed in it: linear light, or sRGB codes; default that of the film, or of what it is an object of

---@class celspan.rostrum: celspan.placed, celspan.rostrum.fields
---@field brightness number
---@field antialias celspan.antialias
local rostrum = {}

--- Cels under one camera. With a size it is also an object; transforms and fades return that
--- object.
---@param fields celspan.rostrum.fields
---@return celspan.rostrum
function celspan.rostrum(fields) end

--- A copy with changes.
---@param changes celspan.rostrum.fields
---@return celspan.rostrum
function rostrum:with(changes) end

--- The part of the film that is visible.
---@class celspan.camera
---@field centre? celspan.point
---@field width? number Of the visible area; more than 0
---@field rotate? number Degrees; turns the camera, so the picture turns the other way; default 0

--- A separable antialiasing filter, normalised, cut off at its radius.
---@class celspan.filter
---@field kernel "box"|"gaussian"|"mitchell"|"lanczos"|fun(x: number): number x: pixels from the centre
---@field radius? number Pixels; a function needs one; 0 to 256; default by the kernel
---@field rows? integer Pieces of the height of a pixel; 1 to 256; default 16

--- The argument of a frame function.
---@class celspan.frame
---@field number integer Counted from `first`
---@field index integer From 0
---@field time number Seconds: index / fps
---@field middle number Seconds at the middle of the frame
---@field count integer
---@field fps number
---@field width integer
---@field height integer
---@field size integer[] {width, height}
---@field progress number 0 at the first frame, 1 at the last
local frame = {}

--- The index held for n frames: f:on(2) animates on twos.
---@param n integer
---@return integer
function frame:on(n) end

--- A random number that depends only on the film, the frame and the label: 0 <= x < 1, or 1..m, or
--- m..n. Of the film, title and size count.
---@param label string|number
---@param m? integer
---@param n? integer
---@return number
function frame:random(label, m, n) end

--- A sound of a film, and when it is heard.
---@class celspan.film.sound
---@field [integer] string|celspan.film A file, an address data:... of one, or a film whose sounds are meant
---@field at? number Second of the film at which it begins; -1e9 to 1e9; default 0
---@field from? number Second of the file at which it begins; 0 to 1e9; default 0
---@field to? number Second of the file at which it ends; more than 0, at most 1e9; default the end of the file
---@field speed? number 2: twice as fast; the pitch is kept; 0.01 to 100; default 1
---@field gain? number A factor of the amplitude; 0 to 1000; default 1
---@field fade? number[] {in, out}; linear in amplitude; default {0, 0}
---@field pan? number -1: left, 1: right, with constant power; -1 to 1; default 0
---@field name? string For `duck` and `under`
---@field duck? string The name of sounds that are lower while this one sounds
---@field under? string The name of sounds under which this one is lower, also of sounds of films
---@field duck_depth? number By how many decibels `duck` and `under` make it lower; 0 to 200; default 12
---@field duck_attack? number Seconds in which it becomes lower, before; 0 to 1e9; default 0.1
---@field duck_release? number Seconds in which it becomes louder again, after; 0 to 1e9; default 0.1

---@class celspan.film.fields
---@field size? integer[] {w, h}; 1 to 1048576; default {1920, 1080}
---@field fps? number Frames per second; more than 0, at most 1000000; default 24
---@field frames? integer How many; 1 to 1e9; default 1
---@field duration? number Seconds, instead of frames; more than 0
---@field first? integer The number of the first frame; -1e9 to 1e9; default 1
---@field title? string
---@field space? "linear"|"srgb" The numbers that are mixed in it: linear light, or sRGB codes; default linear
---@field grain? celspan.grain Grey grain, another one in each frame
---@field sound? string|celspan.film.sound|celspan.film.sound[] A file, a sound, or a list of sounds, which are mixed
---@field sound_offset? number Seconds by which all sounds begin later; a negative value cuts the beginning; -1e9 to 1e9; default 0
---@field marks? table<string, integer> Names of frames, { title = 1 }, for --frames
---@field captions? string|celspan.captions A .srt or .vtt file, or captions: a track of subtitles in videos
---@field poster? integer|string The frame that stands for the film, by its number or a time such as "2s"
---@field frame fun(f: celspan.frame): celspan.exposures A pure function of f

---@class celspan.film: celspan.film.fields
---@field size integer[]
---@field fps number
---@field frames integer
---@field duration number
---@field first integer
---@field sound_offset number
local film = {}

--- The value that a script returns.
---@param fields celspan.film.fields
---@return celspan.film
function celspan.film(fields) end

--- A copy with changes.
---@param changes celspan.film.fields
---@return celspan.film
function film:with(changes) end

--- The result of the frame function for a frame of the film, by its number.
---@param number integer
---@return celspan.exposures
function film:at(number) end

---@class celspan.render.options
---@field frames? string|integer "1-10,20-30:2,45", "2s-4s" or a mark; default all
---@field progress? fun(share: number, frame: integer): boolean? The share of the whole job that is done; false stops
---@field format? string Default by the ending of the file
---@field depth? 8|16|"half"|"float" Bits, or floats
---@field colour? "default"|"linear"|"srgb"|"rec709"|"cineon"
---@field alpha? "default"|"straight"|"premultiplied"
---@field dither? boolean 8 bits without bands
---@field size? integer[] {w, h}; in pixels; default {1920, 1080}
---@field film? number[] {w, h}; in film units; default the size
---@field crop? integer[] {x, y, w, h}; in pixels
---@field workers? integer Threads; 0 or more; default 0: one for each processor
---@field antialias? celspan.antialias Instead of that of each rostrum
---@field tolerance? number How far gradient spans may be from the exact colours, 2^-20 to 1; default 1/1023

--- Renders to files; #### or %04d is the frame's number.
---@param what celspan.film|celspan.rostrum
---@param pattern string
---@param options? celspan.render.options
---@return true? done
---@return string? message
function celspan.render(what, pattern, options) end

--- Pixels in memory, linear and premultiplied.
---@class celspan.pixels.image
---@field width integer
---@field height integer
local raster = {}

--- The colour of one pixel.
---@param x integer From 0
---@param y integer From 0
---@return number r, number g, number b, number a
function raster:get(x, y) end

---@class celspan.bytes.options
---@field depth? 8|16|"half"|"float" Bits, or floats
---@field colour? "default"|"linear"|"srgb"|"rec709"|"cineon"
---@field alpha? "default"|"straight"|"premultiplied"
---@field dither? boolean 8 bits without bands

--- RGBA, rows from top to bottom, little endian.
---@param options? celspan.bytes.options
---@return string
function raster:bytes(options) end

---@class celspan.write.options
---@field format? string Default by the ending of the file
---@field depth? 8|16|"half"|"float" Bits, or floats
---@field colour? "default"|"linear"|"srgb"|"rec709"|"cineon"
---@field alpha? "default"|"straight"|"premultiplied"
---@field dither? boolean 8 bits without bands

--- Writes a file.
---@param path string
---@param options? celspan.write.options
---@return true? done
---@return string? message
function raster:write(path, options) end

---@class celspan.pixels.options
---@field frame? integer Of a film; default its first
---@field size? integer[] {w, h}; in pixels; default {1920, 1080}
---@field film? number[] {w, h}; in film units; default the size
---@field crop? integer[] {x, y, w, h}; in pixels
---@field workers? integer Threads; 0 or more; default 0: one for each processor
---@field antialias? celspan.antialias Instead of that of each rostrum
---@field tolerance? number How far gradient spans may be from the exact colours, 2^-20 to 1; default 1/1023

--- Renders one frame to memory.
---@param what celspan.film|celspan.exposures
---@param options? celspan.pixels.options
---@return celspan.pixels.image? image
---@return string? message
function celspan.pixels(what, options) end

--- A frame without a size: what can be seen of it, as curves.
---@class celspan.plane
---@field width number In film units
---@field height number
---@field bytes integer Of its file
---@field frames integer Of its file
---@field fps number Of a film; 0 of a single plane
local plane = {}

---@class celspan.plane.view
---@field size? integer[] {w, h}; in pixels; default that of the plane, a pixel for each unit
---@field crop? integer[] {x, y, w, h}; in pixels
---@field antialias? "area"|"none" Default "area"

--- Draws it at any size.
---@param options? celspan.plane.view
---@return celspan.pixels.image? image
---@return string? message
function plane:pixels(options) end

--- Another frame of the file.
---@param number integer 1 to plane.frames
---@return celspan.plane? plane
---@return string? message
function plane:frame(number) end

--- Writes a plane file.
---@param path string
---@return true? done
---@return string? message
function plane:write(path) end

---@class celspan.plane.options
---@field depth? 8|16 Bits of colours: 8, a smaller file, or 16; default 16
---@field film? number[] {w, h}; in film units; default that of the film, else {1920, 1080}
---@field frame? integer Of a film; default its first

--- Reduces one frame to a plane.
---@param what celspan.film|celspan.exposures
---@param options? celspan.plane.options
---@return celspan.plane? plane
---@return string? message
function celspan.plane(what, options) end

--- Reads a plane file.
---@param path string Relative to the script
---@return celspan.plane? plane
---@return string? message
function celspan.plane_read(path) end

--- One RGBA (single), those of the first and last pixel (gradient), or one per pixel (array).
---@class celspan.span
---@field x0 integer
---@field x1 integer
---@field kind "single"|"gradient"|"array"
---@field [integer] number

---@class celspan.spans.options
---@field rows? integer[] {first, last}; inclusive, from 0
---@field frame? integer Of a film; default its first
---@field size? integer[] {w, h}; in pixels; default {1920, 1080}
---@field film? number[] {w, h}; in film units; default the size
---@field crop? integer[] {x, y, w, h}; in pixels
---@field workers? integer Threads; 0 or more; default 0: one for each processor
---@field antialias? celspan.antialias Instead of that of each rostrum
---@field tolerance? number How far gradient spans may be from the exact colours, 2^-20 to 1; default 1/1023

--- Rows of spans: rows[y] is a list.
---@param what celspan.film|celspan.exposures
---@param options? celspan.spans.options
---@return table<integer, celspan.span[]>? rows
---@return string? message
function celspan.spans(what, options) end

---@class celspan.probe.options
---@field film? number[] {w, h}; in film units; default that of the film, else {1920, 1080}
---@field frame? integer Of a film; default its first

--- The colour of one point of the film by direct evaluation: no sweep, no antialiasing, no defocus.
---@param what celspan.film|celspan.exposures
---@param x number
---@param y number
---@param options? celspan.probe.options
---@return number? r, number|string g, number b, number a
function celspan.probe(what, x, y, options) end

--- Random numbers from a seed: random(label [, m, n]) depends only on the seed and the label.
---@param seed string|number
---@return fun(label: string|number, m?: integer, n?: integer): number
function celspan.random(seed) end

return celspan
