--- The part of celspan.d.lua that is written by hand: functions, methods, and tables that
--- functions return. celspan.manual puts the annotations of a noun in the place of a line
---
---   ---@noun circle: celspan.object        a value, and the class that it extends
---   ---@noun camera                        a table of options
---
--- from the rows of its fields, which are in src/kit/lua; in the place of a line
---
---   ---@written row: layout.row            celspan.row, which is this function of a module
---
--- what the module says of it; and a method with a line
---
---   ---@own celspan.placed                 returns its own type, of this class
---
--- One file, because it is one text, in the order in which editors show it.
return [==[
---@meta celspan
--- Annotations of celspan for editors with the Lua language server. Film coordinates start at the
--- top left, x to the right, y down. In every list, later is nearer the camera. Angles are degrees,
--- clockwise. Colours are linear light, but strings are sRGB. It is one file because editors load a
--- library as a whole.

---@alias celspan.colour celspan.paint|string A paint, or "#rgb", "#rgba", "#rrggbb", "#rrggbbaa" (sRGB-coded), a name of CSS such as "tomato", or "transparent"
---@alias celspan.surface celspan.colour|celspan.texture What fills a primitive
---@alias celspan.light number[]|string|celspan.paint|celspan.texture|celspan.light_shape {r, g, b}, {r, g, b, a} or "#rrggbb"; an omitted a is 1; or a light with a shape
---@alias celspan.shape celspan.object|celspan.rostrum A part of a cel or a boolean: an object, or a rostrum with a size
---@alias celspan.point number[] {x, y}
---@alias celspan.place celspan.point|"centre"|"top"|"bottom"|"left"|"right"|"top left"|"top right"|"bottom left"|"bottom right"|"pivot" A point, a place of the bounds, or the point that `with { pivot = }` gave
---@alias celspan.rule "nonzero"|"evenodd" How self-crossing outlines are filled
---@alias celspan.mode "normal"|"multiply"|"screen"|"overlay"|"darken"|"lighten"|"color-dodge"|"color-burn"|"hard-light"|"soft-light"|"difference"|"exclusion"|"hue"|"saturation"|"color"|"luminosity"|"add"|"linear-dodge"|"soft-light-photoshop"|"linear-burn"|"vivid-light"|"linear-light"|"pin-light"|"hard-mix"|"subtract"|"divide"|"darker-color"|"lighter-color" How a source is combined with its backdrop
---@alias celspan.antialias "area"|"none"|celspan.filter The exact mean over each pixel, pixel centres, or a kernel
---@alias celspan.exposures celspan.rostrum|table[] A rostrum, or {{rostrum, weight}, ...}: light adds
---@alias celspan.shown celspan.exposures|celspan.object|celspan.cel|table What a frame shows: exposures, an object, a cel, or a list of objects, cels, lists, nil and false, which may have the named fields of a rostrum

--- x, y of the beginning, and six numbers for each piece: two control points and its end.
---@class celspan.contour: number[]
---@field closed? boolean Of a stroke: whether it returns to its beginning

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

---@written row: layout.row
---@written column: layout.column
---@written grid: layout.grid
---@written align: layout.align
---@written fit: layout.fit
---@written morph: morph.between
---@written brush: brush.line
---@written count: count.written
---@written timecode: count.timecode

--- The pictures of a movie, or of numbered files, by their times.
---@class celspan.footage
---@field size number[] {w, h} in pixels, upright, with square pixels
---@field fps number Pictures a second; of a movie without a constant rate the mean
---@field frames integer Pictures from `from` to `to`
---@field seconds number How long these are shown, at the clip's speed
---@field sound boolean Whether the file has one: `sound = "clip.mp4"` of a film plays it
local footage = {}

--- The picture that is shown at a time.
---@param seconds number
---@return celspan.texture
function footage:at(seconds) end

--- The picture with this number.
---@param number integer From 1
---@return celspan.texture
function footage:frame(number) end

---@written footage: footage.open
---@written echo: echo.trail
---@written trim: operators.trim
---@written offset: operators.offset
---@written round_corners: operators.round_corners
---@written zigzag: operators.zigzag
---@written pucker: operators.pucker
---@written twist: operators.twist
---@written repeater: repeater.copies
---@written merge: merge.merged
---@written composite: composite.of
---@written dissolve: dissolve.by_chance
---@written star: star.outline
---@written around: layout.around
---@written letters: layout.letters

--- A value that can have a name. Transforms, fades and `with` keep the name.
---@class celspan.nameable
---@field name? string
---@field origin? string The line that made it, "shot.lua:12"
---@operator len: integer
local nameable = {}

--- The same value with a name, which messages use: 1 to 255 bytes without control characters.
---@own celspan.nameable
---@param name string
function nameable:named(name) end

---@noun paint: celspan.nameable

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

---@noun gradient: celspan.texture

---@noun linear: celspan.texture

---@noun radial: celspan.texture

---@noun conic: celspan.texture

---@noun noise: celspan.texture

---@noun picture: celspan.texture

---@noun pattern: celspan.texture

--- The methods of objects and cels. Each method returns a new value.
---@class celspan.placed: celspan.nameable
---@field mode celspan.mode
---@field pivot? celspan.point
local placed = {}

--- Moves it.
---@own celspan.placed
---@param dx number
---@param dy number
function placed:translate(dx, dy) end

--- Enlarges it, about the origin or a place that stays.
---@own celspan.placed
---@param sx number
---@param sy? number|celspan.place Default sx; a place: sx is for both
---@param cx? number|celspan.place
---@param cy? number
function placed:scale(sx, sy, cx, cy) end

--- Turns clockwise on screen, about the origin or a place.
---@own celspan.placed
---@param degrees number
---@param cx? number|celspan.place
---@param cy? number
function placed:rotate(degrees, cx, cy) end

--- Slants it, about the origin or a place.
---@own celspan.placed
---@param degrees_x number
---@param degrees_y number
---@param cx? number|celspan.place
---@param cy? number
function placed:skew(degrees_x, degrees_y, cx, cy) end

--- Moves a place of it, by default its centre, to a point.
---@own celspan.placed
---@param x number
---@param y number
---@param place? celspan.place
function placed:move_to(x, y, place) end

--- A 3x3 matrix row by row, for column vectors.
---@own celspan.placed
---@param matrix number[] Nine numbers
function placed:transform(matrix) end

--- The perspective that maps the first four points to the second.
---@own celspan.placed
---@param from celspan.point[]
---@param to celspan.point[]
function placed:quad(from, to) end

--- The paint mixed with clear: 1 leaves it unchanged, 0 makes it invisible.
---@own celspan.placed
---@param k number 0..1
function placed:fade(k) end

--- With a blend mode: how it is combined with its backdrop. `mode` reads it.
---@own celspan.placed
---@param mode celspan.mode
function placed:blend(mode) end

--- With a soft shadow behind it, or inside.
---@own celspan.placed
---@param options? celspan.shadow.options
function placed:shadow(options) end

--- With its shape, blurred, added as light behind it.
---@own celspan.placed
---@param options celspan.glow.options
function placed:glow(options) end

--- With its shape, grown by a width, behind it.
---@own celspan.placed
---@param options celspan.outline.options
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
---@own celspan.placed
---@param changes table
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
---@field along? string|celspan.contour[]|celspan.path Path data, contours or a path
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

---@noun rect: celspan.object

---@noun triangle: celspan.object

---@noun circle: celspan.object

---@noun ellipse: celspan.object

---@noun polygon: celspan.object

---@noun nurbs: celspan.object

---@noun path: celspan.object

---@noun stroke.style

---@noun stroke: celspan.object

---@noun image: celspan.object

---@class celspan.text.metrics
---@field ascent number Of a line of the first font, above the baseline
---@field descent number Below it
---@field cap_height number Of capitals
---@field x_height number Of small letters without ascenders
---@field width number Of the widest line
---@field height number From the ascent of the first line to the descent of the last one
---@field lines integer

---@noun text: celspan.object

--- The measures of a text in its own units.
---@return celspan.text.metrics
function text:metrics() end

---@noun glyph: celspan.object

--- A letter of celspan.glyphs.
---@class celspan.letter
---@field object celspan.glyph At its place in the text
---@field x number Its left end
---@field y number Its baseline
---@field advance number Its width, without tracking
---@field middle number x + advance / 2
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

---@noun scanline: celspan.object

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

---@noun group: celspan.object

---@noun key: celspan.object

---@noun blur.options

---@noun displace.options

---@noun sharpen.options

---@noun shadow.options

---@noun glow.options

---@noun outline.options

---@noun matte.options

--- An object that is faded by a matte.
---@class celspan.matte: celspan.boolean, celspan.matte.options

--- The art, present as far as `by` is; `by` is not drawn.
---@param art celspan.shape
---@param by celspan.shape
---@param options? celspan.matte.options
---@return celspan.matte
function celspan.matte(art, by, options) end

---@noun defocus

---@noun grain

---@noun grade

---@noun cel: celspan.placed

---@noun light_shape

---@noun rostrum: celspan.placed

--- A copy with changes.
---@param changes celspan.rostrum.fields
---@return celspan.rostrum
function rostrum:with(changes) end

---@noun camera

---@noun filter

---@noun frame
local frame = {}

--- The index held for n frames: f:on(2) animates on twos.
---@param n integer
---@return integer
function frame:on(n) end

--- The time in seconds held for two frames: animation on twos.
---@return number
function frame:twos() end

--- The time in seconds held for three frames.
---@return number
function frame:threes() end

--- A random number that depends only on the film, the frame and the label: 0 <= x < 1, or 1..m, or
--- m..n. Of the film, title and size count.
---@param label string|number
---@param m? integer
---@param n? integer
---@return number
function frame:random(label, m, n) end

---@noun film.sound

---@noun film

--- A copy with changes.
---@param changes celspan.film.fields
---@return celspan.film
function film:with(changes) end

--- The result of the frame function for a frame of the film, by its number.
---@param number integer
---@return celspan.exposures
function film:at(number) end

---@noun render.options

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

---@noun bytes.options

--- RGBA, rows from top to bottom, little endian.
---@param options? celspan.bytes.options
---@return string
function raster:bytes(options) end

---@noun write.options

--- Writes a file.
---@param path string
---@param options? celspan.write.options
---@return true? done
---@return string? message
function raster:write(path, options) end

---@noun pixels.options

--- Renders one frame to memory.
---@param what celspan.film|celspan.shown
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

---@noun plane.view

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

---@noun plane.options

--- Reduces one frame to a plane.
---@param what celspan.film|celspan.shown
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

---@noun spans.options

--- Rows of spans: rows[y] is a list.
---@param what celspan.film|celspan.shown
---@param options? celspan.spans.options
---@return table<integer, celspan.span[]>? rows
---@return string? message
function celspan.spans(what, options) end

---@noun probe.options

--- The colour of one point of the film by direct evaluation: no sweep, no antialiasing, no defocus.
---@param what celspan.film|celspan.shown
---@param x number
---@param y number
---@param options? celspan.probe.options
---@return number? r, number|string g, number b, number a
function celspan.probe(what, x, y, options) end

--- The globals with celspan's names beside them, for a file in a Lua of one's own: local _ENV =
--- celspan.names(_ENV). A global that the file assigns is not looked up. Scripts that celspan runs
--- have these names already.
---@param globals table
---@return table
function celspan.names(globals) end

--- Random numbers from a seed: random(label [, m, n]) depends only on the seed and the label.
---@param seed string|number
---@return fun(label: string|number, m?: integer, n?: integer): number
function celspan.random(seed) end

---@globals

return celspan
]==]
