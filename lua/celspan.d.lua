---@meta celspan
--- What editors know of celspan: for the Lua language server. Film coordinates start at the top left,
--- x to the right, y down. Later is nearer the camera in every list. Angles are degrees, clockwise.
--- Colours are linear light unless they are written as strings. One file, because editors take it whole.

---@alias celspan.colour celspan.paint|string A paint, or "#rgb", "#rrggbb", "#rrggbbaa" (sRGB-coded)
---@alias celspan.surface celspan.colour|celspan.texture What a primitive's texture may be
---@alias celspan.light number[]|string|celspan.paint|celspan.texture|celspan.light_shape {r, g, b}, {r, g, b, a} or "#rrggbb"; an omitted a is 1; or a light with a shape
---@alias celspan.shape celspan.object|celspan.rostrum What a cel and a boolean hold: objects, and rostrums with a size
---@alias celspan.point number[] {x, y}
---@alias celspan.rule "nonzero"|"evenodd" How self-crossing outlines are filled
---@alias celspan.antialias "area"|"none"|celspan.filter The exact mean over each pixel, pixel centres, or a kernel
---@alias celspan.exposures celspan.rostrum|table[] A rostrum, or {{rostrum, weight}, ...}: light adds

---@class celspan
---@field _VERSION string "celspan 0.1.0"
---@field clear celspan.paint Nothing at all: light passes unchanged
local celspan = {}

-- ------------------------------------------------------------------ names

--- What has a name, for people. Transforms, fades and `with` keep it.
---@class celspan.nameable
---@field name? string
---@field origin? string Where it was made, "shot.lua:12"
---@operator len: integer
local nameable = {}

--- The same value under a name, which messages use: 1 to 255 bytes without control characters.
---@generic T: celspan.nameable
---@param self T
---@param name string
---@return T
function nameable:named(name) end

-- ------------------------------------------------------------------ paints

--- How a surface treats light: `pigment` reflects the front light, `medium` filters what comes from
--- behind, `beta` says how much of the one and the other. All values are straight, 0..1.
---@class celspan.paint: celspan.nameable
---@field pigment number[] {r, g, b}
---@field medium number[] {r, g, b}
---@field beta number
local paint = {}

--- A copy with changes.
---@param changes celspan.paint.fields
---@return celspan.paint
function paint:with(changes) end

---@class celspan.paint.fields
---@field pigment? number[]|string {r, g, b} or "#rrggbb"; default black
---@field medium? number[]|string {r, g, b} or "#rrggbb"; default white, which is clear
---@field beta? number Default 1, all pigment

--- A paint of the Beta colour model.
---@param fields celspan.paint.fields
---@return celspan.paint
function celspan.paint(fields) end

--- A pigment over a clear medium.
---@param r number
---@param g number
---@param b number
---@param alpha? number Default 1
---@return celspan.paint
---@overload fun(colour: string, alpha?: number): celspan.paint
function celspan.rgb(r, g, b, alpha) end

--- A pure filter, like a coloured gel: it is seen only in the light from behind.
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

-- ------------------------------------------------------------------ textures

--- A gradient or a picture, in the units of the primitive it is given to; it moves with it.
---@class celspan.texture: celspan.nameable
local texture = {}

--- A copy with changes.
---@param changes table
---@return celspan.texture
function texture:with(changes) end

---@class celspan.gradient: celspan.texture
---@field [integer] table Three corners {x, y, paint}

--- The triangle gradient: three corners {x, y, paint}, continued outside.
---@param corners table[]
---@return celspan.gradient
function celspan.gradient(corners) end

---@class celspan.linear.fields
---@field from celspan.point Where 0 lies
---@field to celspan.point Where 1 lies
---@field spread? "hold"|"repeat"|"reflect" What lies before 0 and after 1; default: "hold"
---@field matrix? number[] Nine numbers: moves the gradient alone
---@field [integer] table Stops {at, paint}, at ascending in 0..1

---@class celspan.linear: celspan.texture, celspan.linear.fields

--- A gradient along a line; held outside, or repeated.
---@param fields celspan.linear.fields
---@return celspan.linear
function celspan.linear(fields) end

---@class celspan.radial.fields
---@field centre celspan.point
---@field radius number Of the circle where 1 lies
---@field focus? celspan.point Where 0 lies; default: the centre
---@field spread? "hold"|"repeat"|"reflect" What lies before 0 and after 1; default: "hold"
---@field matrix? number[] Nine numbers: moves the gradient alone
---@field [integer] table Stops {at, paint}, at ascending in 0..1

---@class celspan.radial: celspan.texture, celspan.radial.fields

--- A gradient around a point; held outside, or repeated.
---@param fields celspan.radial.fields
---@return celspan.radial
function celspan.radial(fields) end

---@class celspan.picture.common
---@field file? string Relative to the script; needed, or `pixels` in its place
---@field colour? string "srgb", "linear", "rec709", "cineon"; default by the file
---@field sampling? "auto"|"nearest"|"bilinear"|"bicubic"
---@field as? "paint"|"gel" Painted, or a slide lit from behind
---@field wrap? "clear"|"clamp"|"repeat" Outside the box
---@field subimage? integer From 0
---@field layer? string The name of a subimage
---@field source? integer[] {x, y, w, h}: a part of the picture, in its pixels
---@field pixels? string Pixels in memory, rows from top to bottom without gaps
---@field size? number[] {width, height} of the pixels
---@field format? "rgba8"|"rgb8"|"grey8"|"rgba16"|"rgbaf" Of the pixels, in the machine's byte order; default "rgba8"
---@field alpha? "straight"|"premultiplied" Of the pixels; default integers straight, floats premultiplied

---@class celspan.picture.fields: celspan.picture.common
---@field box? number[] {x, y, w, h}; default the primitive's bounding rectangle

---@class celspan.picture: celspan.texture, celspan.picture.fields
---@field sampling "auto"|"nearest"|"bilinear"|"bicubic"
---@field as "paint"|"gel"
---@field wrap "clear"|"clamp"|"repeat"

--- A picture as a texture: a file, read when it is first seen, or pixels in memory.
---@param fields celspan.picture.fields
---@return celspan.picture
function celspan.picture(fields) end

-- ------------------------------------------------------------------ objects

--- What objects and cels can do. Each method returns a new value.
---@class celspan.placed: celspan.nameable
local placed = {}

---@generic T: celspan.placed
---@param self T
---@param dx number
---@param dy number
---@return T
function placed:translate(dx, dy) end

--- About the origin, or a centre that stays where it is.
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

--- The perspective that takes the first four points to the second.
---@generic T: celspan.placed
---@param self T
---@param from celspan.point[]
---@param to celspan.point[]
---@return T
function placed:quad(from, to) end

--- The paint mixed with clear: 1 leaves it, 0 makes it vanish.
---@generic T: celspan.placed
---@param self T
---@param k number 0..1
---@return T
function placed:fade(k) end

--- The smallest upright rectangle around it; nothing when there is nothing to paint.
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

---@class celspan.rect.fields
---@field [integer] number x, y, width, height
---@field radius? number Of the corners; default 0
---@field texture? celspan.surface Default opaque black

---@class celspan.rect: celspan.object, celspan.rect.fields
---@field radius number
---@field texture celspan.surface

---@param fields celspan.rect.fields
---@return celspan.rect
function celspan.rect(fields) end

---@class celspan.triangle.fields
---@field [integer] celspan.point Three points
---@field texture? celspan.surface

---@class celspan.triangle: celspan.object, celspan.triangle.fields
---@field texture celspan.surface

---@param fields celspan.triangle.fields
---@return celspan.triangle
function celspan.triangle(fields) end

---@class celspan.circle.fields
---@field centre celspan.point
---@field radius number
---@field texture? celspan.surface

---@class celspan.circle: celspan.object, celspan.circle.fields
---@field texture celspan.surface

---@param fields celspan.circle.fields
---@return celspan.circle
function celspan.circle(fields) end

---@class celspan.ellipse.fields
---@field centre celspan.point
---@field radii number[] {rx, ry}
---@field texture? celspan.surface

---@class celspan.ellipse: celspan.object, celspan.ellipse.fields
---@field texture celspan.surface

---@param fields celspan.ellipse.fields
---@return celspan.ellipse
function celspan.ellipse(fields) end

---@class celspan.polygon.fields
---@field [integer] celspan.point
---@field rule? celspan.rule
---@field texture? celspan.surface

---@class celspan.polygon: celspan.object, celspan.polygon.fields
---@field rule celspan.rule
---@field texture celspan.surface

---@param fields celspan.polygon.fields
---@return celspan.polygon
function celspan.polygon(fields) end

---@class celspan.nurbs.fields
---@field points number[][] {x, y} or {x, y, weight}; the point itself, not multiplied by its weight
---@field degree? integer 1..15, default 3
---@field knots? number[] Default uniform
---@field closed? "periodic"|"clamped"
---@field rule? celspan.rule
---@field texture? celspan.surface

---@class celspan.nurbs: celspan.object, celspan.nurbs.fields
---@field degree integer
---@field closed "periodic"|"clamped"
---@field rule celspan.rule
---@field texture celspan.surface

--- A closed curve of any degree, weighted or not.
---@param fields celspan.nurbs.fields
---@return celspan.nurbs
function celspan.nurbs(fields) end

---@class celspan.path.fields
---@field d string SVG path data; open subpaths are closed
---@field rule? celspan.rule
---@field texture? celspan.surface

---@class celspan.path: celspan.object, celspan.path.fields
---@field rule celspan.rule
---@field texture celspan.surface

---@param fields celspan.path.fields
---@return celspan.path
function celspan.path(fields) end

---@class celspan.stroke.style
---@field width? number Default 1; of points without one
---@field cap? "butt"|"round"|"square" Default "butt"
---@field join? "miter"|"round"|"bevel" Default "miter"
---@field miter? number Default 4: the longest miter, in widths
---@field dash? number[] Lengths drawn and left out in turn
---@field dash_offset? number Default 0
---@field taper? number[] {begin, end}: lengths over which the width grows from 0 and falls to 0
---@field from? number Default 0: where drawing begins, in shares of the whole length
---@field to? number Default 1
---@field texture? celspan.surface

---@class celspan.stroke.fields: celspan.stroke.style
---@field points? number[][] {x, y} or {x, y, width}
---@field degree? integer 1..15, default 1: of the spline through the points
---@field closed? boolean Whether the points come back to the first
---@field d? string SVG path data; Z closes a subpath
---@field outline? celspan.object A primitive, in its own units

---@class celspan.stroke: celspan.object, celspan.stroke.fields
---@field width number
---@field cap "butt"|"round"|"square"
---@field join "miter"|"round"|"bevel"
---@field miter number
---@field dash_offset number
---@field degree integer
---@field from number
---@field to number
---@field texture celspan.surface

--- A line with a width: of points, d and outline, one is given.
---@param fields celspan.stroke.fields
---@return celspan.stroke
function celspan.stroke(fields) end

---@class celspan.image.fields: celspan.picture.common
---@field x? number Default 0
---@field y? number Default 0
---@field w? number Default the picture's width; one alone keeps the aspect
---@field h? number
---@field fit? "fill"|"contain"|"cover" When both w and h are given

---@class celspan.image: celspan.object, celspan.image.fields
---@field sampling "auto"|"nearest"|"bilinear"|"bicubic"
---@field as "paint"|"gel"
---@field wrap "clear"|"clamp"|"repeat"
---@field x number
---@field y number
---@field fit "fill"|"contain"|"cover"

--- A rectangle textured with a picture.
---@param fields celspan.image.fields
---@return celspan.image
function celspan.image(fields) end

---@class celspan.text.common
---@field font string|string[] Files; each letter is taken from the first font that has it
---@field width? number Lines wrap, and align within at[1] .. at[1] + width
---@field features? table<string, boolean|integer> Of OpenType: { liga = false, ss01 = true, salt = 2 }
---@field variations? table<string, number> Axes of variable fonts: { wght = 700 }
---@field language? string "en", "tr", "zh-Hant"
---@field face? integer Of files that are collections (.ttc, .otc): which of their fonts; default 1

---@class celspan.text.fields: celspan.text.common
---@field [integer] string The text; \n breaks lines
---@field size? number The em; default 48
---@field at? number[] {x, y}: the first line's baseline; default {0, 0}
---@field align? "left"|"centre"|"right" Default "left", in every script
---@field leading? number From baseline to baseline, times size; default 1.2
---@field tracking? number Thousandths of an em after each letter; default 0
---@field direction? "auto"|"ltr"|"rtl" Default by the first letter of each line that was typed
---@field texture? celspan.surface

---@class celspan.text: celspan.object, celspan.text.common
---@field [integer] string
---@field face integer
---@field size number
---@field at? number[]
---@field align "left"|"centre"|"right"
---@field leading number
---@field tracking number
---@field direction? "auto"|"ltr"|"rtl"
---@field texture celspan.surface

--- Letters of a font as one primitive.
---@param fields celspan.text.fields
---@return celspan.text
function celspan.text(fields) end

--- A letter as an object; `with` makes it anew, as the letter of that index of the changed text.
---@class celspan.glyph: celspan.text
---@field index integer From 1

---@class celspan.letter
---@field object celspan.glyph It lies where the text has it
---@field x number Its left end
---@field y number Its baseline
---@field advance number Its width, without tracking
---@field text string
---@field line integer From 1

--- The same, letter by letter, in the order of reading.
---@param fields celspan.text.fields
---@return celspan.letter[]
function celspan.glyphs(fields) end

---@class celspan.scanline.row
---@field x0 number The part that can be seen
---@field x1 number
---@field pixel number The width of a pixel

---@class celspan.scanline.fields
---@field bounds number[] {x, y, w, h}
---@field spans fun(y: number, row: celspan.scanline.row): table[] {x0, x1, paint [, paint]} or {x0, x1, array = {paint, ...}}

---@class celspan.scanline: celspan.object
---@field spans fun(y: number, row: celspan.scanline.row): table[]

--- A primitive given by a function that returns its spans on a row.
---@param fields celspan.scanline.fields
---@return celspan.scanline
function celspan.scanline(fields) end

--- What the operators and the functions below make.
---@class celspan.boolean: celspan.object
---@field [integer] celspan.shape Its operands

--- Later over earlier; a | b.
---@param objects celspan.shape[]
---@return celspan.boolean
function celspan.union(objects) end

--- Where all are, later over earlier; a & b.
---@param objects celspan.shape[]
---@return celspan.boolean
function celspan.intersection(objects) end

--- The first where no other is; a - b.
---@param objects celspan.shape[]
---@return celspan.boolean
function celspan.difference(objects) end

--- Where an odd number are; a ~ b.
---@param objects celspan.shape[]
---@return celspan.boolean
function celspan.xor(objects) end

--- The art where the shape is; the shape's own texture is not painted.
---@param art celspan.shape
---@param shape celspan.shape
---@return celspan.boolean
function celspan.clip(art, shape) end

-- ------------------------------------------------------------------ cels and rostrum

---@class celspan.cel: celspan.placed, celspan.cel.fields
---@field opacity number

---@class celspan.cel.fields
---@field [integer] celspan.shape
---@field front? celspan.light Default the rostrum's, else white
---@field back? celspan.light Shines through the whole frame behind this cel; default none
---@field viewport? number[] {x, y, w, h}: the part that fills the frame
---@field defocus? number|{radius: number, kernel?: "gaussian"|"box"|"disc"} Film units on the frame
---@field opacity? number 0..1, default 1

--- A sheet with objects and lights of its own.
---@param fields celspan.cel.fields
---@return celspan.cel
function celspan.cel(fields) end

--- A light with a shape: gain times beta times pigment at each point.
---@class celspan.light_shape
---@field texture celspan.surface
---@field gain? number 0 or more, default 1
---@field on? "frame"|"cel" In film units on the frame (default), or in the cel's units, moving with it
---@field matte? number 0..1, default 1: as a back light, what its beta is multiplied by to be the matte

--- With a size it is an object too; transforms and fades give that object.
---@class celspan.rostrum: celspan.placed, celspan.rostrum.fields
---@field brightness number
---@field antialias celspan.antialias
local rostrum = {}

--- A copy with changes.
---@param changes celspan.rostrum.fields
---@return celspan.rostrum
function rostrum:with(changes) end

---@class celspan.camera
---@field centre? celspan.point
---@field width? number Of what is seen
---@field rotate? number Degrees; turns the camera, so the picture turns back

--- A separable antialiasing filter, normalised, cut at its radius.
---@class celspan.filter
---@field kernel? "box"|"gaussian"|"mitchell"|"lanczos"|fun(x: number): number x: pixels from the centre
---@field radius? number Pixels, 0..256; default by the kernel; a function needs one
---@field rows? integer 1..256, pieces of a pixel's height, default 16

---@class celspan.rostrum.fields
---@field [integer] celspan.cel
---@field front? celspan.light For the cels that name none
---@field back? celspan.light Behind the rearmost cel: "#fff" is a white ground
---@field brightness? number Multiplies the light, not alpha; default 1
---@field camera? celspan.camera
---@field antialias? celspan.antialias Default "area"
---@field size? number[] {w, h}, film units: its own film, which it needs as an object

--- Cels under one camera.
---@param fields celspan.rostrum.fields
---@return celspan.rostrum
function celspan.rostrum(fields) end

-- ------------------------------------------------------------------ films

--- What a frame function is given.
---@class celspan.frame
---@field number integer From `first` on
---@field index integer From 0
---@field time number Seconds: index / fps
---@field middle number Seconds at the middle of the frame
---@field count integer
---@field fps number
---@field width integer
---@field height integer
---@field progress number 0 at the first frame, 1 at the last
local frame = {}

--- The index held for n frames: f:on(2) animates on twos.
---@param n integer
---@return integer
function frame:on(n) end

--- A number that depends on film, frame and label alone: 0 <= x < 1, or 1..m, or m..n. The film
--- counts by its title and size.
---@param label string|number
---@param m? integer
---@param n? integer
---@return number
function frame:random(label, m, n) end

---@class celspan.film.fields
---@field size? integer[] {width, height}; default {1920, 1080}
---@field fps? number Default 24
---@field frames? integer
---@field duration? number Seconds, instead of frames
---@field first? integer The first frame's number, default 1
---@field title? string
---@field sound? string A file: the sound of videos
---@field sound_offset? number Seconds: the film's time at which the sound begins, default 0; a negative one cuts its beginning
---@field frame fun(f: celspan.frame): celspan.exposures A pure function of f

---@class celspan.film: celspan.film.fields
---@field size integer[]
---@field fps number
---@field frames integer
---@field duration number Seconds
---@field first integer
---@field sound_offset number
local film = {}

--- A copy with changes.
---@param changes celspan.film.fields
---@return celspan.film
function film:with(changes) end

--- What the frame function returns for a frame of the film, by its number.
---@param number integer
---@return celspan.exposures
function film:at(number) end

--- What a script returns.
---@param fields celspan.film.fields
---@return celspan.film
function celspan.film(fields) end

-- ------------------------------------------------------------------ rendering

---@class celspan.options
---@field size? integer[] {width, height} in pixels; default {1920, 1080}
---@field film? number[] {width, height} in film units; default the size
---@field crop? integer[] {x, y, width, height} in pixels
---@field workers? integer Default one a processor
---@field antialias? celspan.antialias Instead of each rostrum's own
---@field tolerance? number How far gradient spans may be from the colours they stand for, 2^-20 to 1; default 1/1023

---@class celspan.render.options: celspan.options
---@field frames? string|integer "1-10,20-30:2,45"; default all
---@field format? string Default by the file's ending
---@field depth? 8|16|"half"|"float"
---@field colour? "linear"|"srgb"|"rec709"|"cineon"
---@field alpha? "straight"|"premultiplied"
---@field dither? boolean 8 bits without bands
---@field progress? fun(share: number, frame: integer): boolean? The share of the whole job; false stops

--- Renders into files; #### or %04d is the frame's number.
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
local image = {}

---@param x integer From 0
---@param y integer From 0
---@return number r, number g, number b, number a
function image:get(x, y) end

---@class celspan.bytes.options
---@field depth? 8|16|"half"|"float" Default 8
---@field colour? "linear"|"srgb"|"rec709"|"cineon"
---@field alpha? "straight"|"premultiplied"
---@field dither? boolean 8 bits without bands

--- RGBA, rows from top to bottom, little endian.
---@param options? celspan.bytes.options
---@return string
function image:bytes(options) end

---@class celspan.write.options: celspan.bytes.options
---@field format? string Default by the file's ending

--- Writes a file.
---@param path string
---@param options? celspan.write.options
---@return true? done
---@return string? message
function image:write(path, options) end

---@class celspan.pixels.options: celspan.options
---@field frame? integer Of a film; default its first

---@param what celspan.film|celspan.exposures
---@param options? celspan.pixels.options
---@return celspan.pixels.image? image
---@return string? message
function celspan.pixels(what, options) end

--- One RGBA (single), those of the first and last pixel (gradient), or one a pixel (array).
---@class celspan.span
---@field x0 integer
---@field x1 integer
---@field kind "single"|"gradient"|"array"
---@field [integer] number

---@class celspan.spans.options: celspan.pixels.options
---@field rows? integer[] {first, last}, inclusive, from 0

--- Rows of spans: rows[y] is a list.
---@param what celspan.film|celspan.exposures
---@param options? celspan.spans.options
---@return table<integer, celspan.span[]>? rows
---@return string? message
function celspan.spans(what, options) end

--- The colour of one point of the film by direct evaluation: no sweep, no antialiasing, no defocus.
---@param what celspan.film|celspan.exposures
---@param x number
---@param y number
---@param options? {film?: number[], frame?: integer}
---@return number? r, number|string g, number b, number a
function celspan.probe(what, x, y, options) end

--- Random numbers of a seed: random(label [, m, n]) depends on the seed and the label alone.
---@param seed string|number
---@return fun(label: string|number, m?: integer, n?: integer): number
function celspan.random(seed) end

return celspan
