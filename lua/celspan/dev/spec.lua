--- Assertions about films for busted: about frames, points, cels and rows.
--
--   require "celspan.spec"                         -- adds them to luassert
--   assert.frame(film, 12).looks_like "walk.png"
--   assert.point(film, 1, 320, 200).shows "#ffe9c2"
--   assert.cel(film, 24, "hand").is_visible()      assert.cel(film, 24, "hand").is_not.visible()
--   assert.cel(film, 1, "sky").covers(0.5)
--   assert.frames(film, 1, 25).look_alike()
--   assert.row(film, 1, 0).holds { single = 1, array = 0 }
--
-- The first word names the subject, the last one the claim; `is_not`, before either of them,
-- negates. No claim has the name of a filler word of luassert, because these pass with any
-- arguments.
--
-- One file, because most of it is one table of claims with their messages, which busted takes at
-- once.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"

local spec = {}

---@class celspan.spec.frame
---@field looks_like fun(png: string, options?: { tolerance?: number }) Tolerance 0..1, default 1/255
---@class celspan.spec.point
---@field shows fun(colour: celspan.colour, tolerance?: number)
---@class celspan.spec.cel
---@field is_visible fun()
---@field covers fun(share: number) At least, 0..1
---@class celspan.spec.frames
---@field look_alike fun()
---@class celspan.spec.row
---@field holds fun(counts: { single?: integer, gradient?: integer, array?: integer })

---@class luassert.internal
---@field frame fun(film: celspan.film|celspan.rostrum, n: integer): celspan.spec.frame
---@field point fun(film: celspan.film|celspan.rostrum, n: integer, x: number, y: number): celspan.spec.point
---@field cel fun(film: celspan.film|celspan.rostrum, n: integer, name: string): celspan.spec.cel
---@field frames fun(film: celspan.film|celspan.rostrum, m: integer, n: integer, ...: integer): celspan.spec.frames
---@field row fun(film: celspan.film|celspan.rostrum, n: integer, y: integer): celspan.spec.row

local has_luassert, luassert = pcall(require, "luassert")
if not has_luassert then
  error("celspan.spec adds assertions to luassert, which is not installed: install busted "
    .. "(Debian's package lua-busted) and run specs with `celspan test`", 0)
end
local say = require "say"

-- ---------------------------------------------------------------- the spec

--- Whether a level of the stack belongs to the spec: neither to this library nor to luassert.
local function is_foreign(info)
  return info.currentline > 0 and not info.source:find "^@celspan/"
    and not info.source:find "[/\\]luassert[/\\]"
end

--- The level of the spec's line, as error() counts it in the calling function, and its source.
local function spec_level()
  local level = 2
  while true do
    local info = debug.getinfo(level, "Sl")
    if not info then return 1, "" end
    if is_foreign(info) then return level - 1, info.source end
    level = level + 1
  end
end

local function refuse(message)
  error(message, (spec_level()))
end

--- fields.check, with errors at the line of the spec.
local function check(...)
  local good, message = pcall(fields.check, ...)
  if not good then refuse(message) end
end

--- A difference of one 8-bit step, with room for rounding.
local ONE_CODE = 1 / 255 + 1e-9

-- ---------------------------------------------------------------- what is asked about

local nothing = celspan.rostrum {}
local film_metatable = getmetatable(celspan.film { frame = function() return nothing end })
local rostrum_metatable = getmetatable(nothing)

--- A film; a rostrum becomes a film of one frame.
local function film_of(word, what)
  if getmetatable(what) == film_metatable then return what end
  if getmetatable(what) == rostrum_metatable then
    return celspan.film { size = what.size, space = what.space, frame = function() return what end }
  end
  refuse(("%s takes a film first, got %s"):format(word, fields.kind(what)))
end

local function check_frame(word, film, frame)
  local last = film.first + film.frames - 1
  if math.type(frame) ~= "integer" and not (fields.is_finite(frame) and frame % 1 == 0) then
    refuse(("%s takes the number of a frame, got %s"):format(word, fields.shown(frame)))
  end
  if frame < film.first or frame > last then
    refuse(("%s: frame %d: the film has frames %d to %d"):format(word, frame, film.first, last))
  end
end

local function check_number(word, name, value)
  if not fields.is_finite(value) then
    refuse(("%s: %s must be a finite number, got %s"):format(word, name, fields.shown(value)))
  end
end

--- word -> function(arguments): checks the arguments of the word and returns the subject.
local subjects = {}

local function subject_of(word, arguments)
  local film = film_of(word, arguments[1])
  check_frame(word, film, arguments[2])
  return { word = word, film = film, frame = arguments[2] }
end

function subjects.frame(arguments) return subject_of("frame", arguments) end

function subjects.point(arguments)
  local subject = subject_of("point", arguments)
  subject.x, subject.y = arguments[3], arguments[4]
  check_number("point", "x", subject.x)
  check_number("point", "y", subject.y)
  return subject
end

function subjects.cel(arguments)
  local subject = subject_of("cel", arguments)
  subject.name = arguments[3]
  if type(subject.name) ~= "string" then
    refuse("cel takes the name of a cel third, got " .. fields.shown(subject.name))
  end
  return subject
end

function subjects.frames(arguments)
  local subject = subject_of("frames", arguments)
  if arguments.n < 3 then refuse("frames takes a film and two frames or more") end
  subject.frames = {}
  for i = 2, arguments.n do
    check_frame("frames", subject.film, arguments[i])
    subject.frames[i - 1] = arguments[i]
  end
  return subject
end

function subjects.row(arguments)
  local subject = subject_of("row", arguments)
  local y, height = arguments[3], subject.film.size[2]
  if not fields.is_finite(y) or y % 1 ~= 0 or y < 0 or y >= height then
    refuse(("row: y must be a whole number from 0 to %d, got %s"):format(height - 1,
      fields.shown(y)))
  end
  subject.y = math.tointeger(y)
  return subject
end

-- ---------------------------------------------------------------- looking

--- Returns the value, or raises the message at the spec's line.
local function need(value, message)
  if value == nil then refuse(message) end
  return value
end

local function pixels_of(what, options)
  local image, message = celspan.pixels(what, options)
  return need(image, message)
end

local function frame_pixels(subject)
  return pixels_of(subject.film, { frame = subject.frame })
end

--- The exposures of a frame, each {rostrum, weight}.
local function exposures_of(subject)
  return native.exposures("film:at", subject.film:at(subject.frame))
end

--- The cels of a rostrum for which `keeps` is true, and all names.
local function sort_cels(rostrum, keeps, names)
  local kept = {}
  for _, cel in ipairs { table.unpack(rostrum) } do
    if cel.name then names[cel.name] = true end
    local own = keeps(cel)
    if own then kept[#kept + 1] = own end
  end
  return kept
end

--- Raises an error unless a cel of the frame has the name; the message lists the known names.
local function need_name(subject, names)
  if names[subject.name] then return end
  local list = ordered.names(names)
  local hint = native.nearest(subject.name, list)
  refuse(("frame %d has no cel named %q%s"):format(subject.frame, subject.name,
    hint and ("; did you mean %q?"):format(hint)
      or #list > 0 and "; there are " .. table.concat(list, ", ")
      or "; give it one with cel:named(" .. ("%q"):format(subject.name) .. ")"))
end

--- A copy of the film with one changed frame. `keep` is called for each cel of that frame, and
--- returns the cel that replaces it, or none. more: other changed fields of the rostrums.
local function changed_film(subject, keep, more)
  local names, list = {}, {}
  for i, exposure in ipairs(exposures_of(subject)) do
    local changes = { table.unpack(sort_cels(exposure[1], keep, names)) }
    for name, value in pairs(more) do changes[name] = value end
    if #changes == 0 then changes[1] = celspan.cel {} end
    list[i] = { exposure[1]:with(changes), exposure[2] }
  end
  need_name(subject, names)
  return subject.film:with { frame = function() return list end }
end

-- ---------------------------------------------------------------- pictures

--- "spec/walk.png" -> "spec/walk.actual.png"
local function beside(path, what)
  return (path:gsub("(%.[^./]*)$", "." .. what .. ".png"))
end

--- The difference of two images of the same size.
local function difference_of(first, second, tolerance)
  local coding = { depth = 8, colour = "srgb", alpha = "straight" }
  local count, largest, x, y, channel, picture = native.difference(first:bytes(coding),
    second:bytes(coding), first.width, tolerance)
  return { count = count, largest = largest, x = x, y = y, channel = channel, picture = picture }
end

--- A relative name is relative to the spec.
local function file_beside_spec(name)
  local _, source = spec_level()
  local folder = name:sub(1, 1) ~= "/" and source:match "^@(.*/)" or ""
  return folder .. name
end

local function exists(path)
  local file = io.open(path, "rb")
  if file then file:close() end
  return file ~= nil
end

--- A path quoted for a shell.
local function quoted(path)
  return path:find "^[%w_./-]+$" and path or "'" .. path:gsub("'", "'\\''") .. "'"
end

--- Writes the frame beside the picture. Returns the lines that say how to accept it.
local function write_actual(path, image)
  local actual = beside(path, "actual")
  need(image:write(actual), ("%s cannot be written"):format(actual))
  local is_png = path:lower():find "%.png$"
  return ("  it shows       %s\n  to accept it   %s %s %s"):format(actual,
    is_png and "mv" or "celspan convert", quoted(actual), quoted(path))
end

local function write_difference(path, found, image)
  local seen, size = beside(path, "difference"), { image.width, image.height }
  local drawn = celspan.image { pixels = found.picture, size = size, x = 0, y = 0 }
  local rostrum = celspan.rostrum { antialias = "none", celspan.cel { drawn } }
  need(celspan.render(rostrum, seen, { size = size }), ("%s cannot be written"):format(seen))
  return ("  where          %s"):format(seen)
end

--- The absolute path, because a relative one would be searched for beside the Lua file that names
--- it.
local function from_root(path)
  return path:sub(1, 1) == "/" and path or require "lfs".currentdir() .. "/" .. path
end

--- A picture file as an image of its own size.
local function read_picture(path)
  local made, drawn = pcall(celspan.image, { file = from_root(path) })
  if not made then refuse(drawn) end
  local _, _, width, height = drawn:bounds()
  local rostrum = celspan.rostrum { antialias = "none", celspan.cel { drawn } }
  return pixels_of(rostrum, { size = { math.tointeger(width), math.tointeger(height) } })
end

local function forget(path)
  os.remove(beside(path, "actual"))
  os.remove(beside(path, "difference"))
end

-- ---------------------------------------------------------------- claims

--- word -> function(subject, arguments): whether the claim is true, and the message if the
--- assertion, or its negation, fails.
local claims = {}

local function tolerance_of(word, given)
  if given == nil then return ONE_CODE end
  if not fields.is_finite(given) or given < 0 or given > 1 then
    refuse(("%s: tolerance must be a number from 0 to 1, got %s"):format(word, fields.shown(given)))
  end
  return given + 1e-9
end

local function code(value) return ("%.4g"):format(value * 255) end

--- The message for a picture of the same size that differs.
local function tell_difference(subject, name, found, tolerance, image)
  return ("frame %d does not look like %s: %d of %d pixels differ by more than %s codes of 8 "
    .. "bits;\n  most by %s codes, at x %d, y %d, channel %s")
    :format(subject.frame, name, found.count, image.width * image.height, code(tolerance),
      code(found.largest), found.x, found.y, found.channel)
end

function claims.looks_like(subject, arguments)
  local name, options = arguments[1], arguments[2] or {}
  if type(name) ~= "string" then
    refuse("looks_like takes the name of a picture, got " .. fields.shown(name))
  end
  check("looks_like", options, { tolerance = "number" })
  local tolerance = tolerance_of("looks_like", options.tolerance)
  local path, image = file_beside_spec(name), frame_pixels(subject)
  if not exists(path) then
    refuse(("frame %d cannot be compared: there is no %s yet\n%s"):format(subject.frame, path,
      write_actual(path, image)))
  end
  local picture = read_picture(path)
  if picture.width ~= image.width or picture.height ~= image.height then
    return false, function()
      return ("frame %d does not look like %s: it is %d x %d pixels, the picture is %d x %d\n%s")
        :format(subject.frame, path, image.width, image.height, picture.width, picture.height,
          write_actual(path, image))
    end
  end
  local found = difference_of(image, picture, tolerance)
  if found.count > 0 then
    return false, function()
      return table.concat({ tell_difference(subject, path, found, tolerance, image),
        write_difference(path, found, image), write_actual(path, image) }, "\n")
    end
  end
  forget(path)
  return true, ("frame %d looks like %s, and it should not: no pixel differs by more than %s codes "
    .. "of 8 bits"):format(subject.frame, path, code(tolerance))
end

--- "#rrggbb", or with its alpha "#rrggbbaa", and the four codes, of a linear premultiplied colour.
local function coded(r, g, b, a)
  local paint = a > 0 and celspan.rgb(math.min(1, r / a), math.min(1, g / a), math.min(1, b / a), a)
    or celspan.clear
  local drawn = celspan.rect { 0, 0, 1, 1, texture = paint }
  local one = pixels_of(celspan.rostrum { antialias = "none", celspan.cel { drawn } },
    { size = { 1, 1 } })
  local red, green, blue, alpha = ("<ffff"):unpack(one:bytes { depth = "float", colour = "srgb",
    alpha = "straight" })
  local function byte(value) return math.floor(value * 255 + 0.5) end
  local text = ("#%02x%02x%02x"):format(byte(red), byte(green), byte(blue))
  return alpha > 1 - 0.5 / 255 and text or text .. ("%02x"):format(byte(alpha)),
    { red, green, blue, alpha }
end

--- The colour of a paint in white light, with nothing behind it.
local function shown_by(paint)
  local made, drawn = pcall(celspan.rect, { 0, 0, 1, 1, texture = paint })
  if not made then
    refuse(("shows takes a colour or a paint, got %s"):format(type(paint) == "string"
      and ("%q"):format(paint) or fields.shown(paint)))
  end
  return celspan.probe(celspan.rostrum { celspan.cel { drawn } }, 0.5, 0.5, { film = { 1, 1 } })
end

function claims.shows(subject, arguments)
  local tolerance = tolerance_of("shows", arguments[2])
  local wanted, wanted_codes = coded(shown_by(arguments[1]))
  local r, g, b, a = celspan.probe(subject.film, subject.x, subject.y, { frame = subject.frame })
  need(r, g)
  local found, codes = coded(r, g, b, a)
  local most = 0
  for i = 1, 4 do
    local is_nothing = i < 4 and (codes[4] == 0 or wanted_codes[4] == 0)
    most = is_nothing and most or math.max(most, math.abs(codes[i] - wanted_codes[i]))
  end
  local place = ("frame %d shows %s at %.14g, %.14g"):format(subject.frame, found, subject.x,
    subject.y)
  if most > tolerance then
    return false, ("%s, not %s: they differ by %s codes of 8 bits, more than %s"):format(place,
      wanted, code(most), code(tolerance))
  end
  return true, place .. ", and it should not"
end

function claims.visible(subject, _)
  local function others(cel) return cel.name ~= subject.name and cel or nil end
  local rest = pixels_of(changed_film(subject, others, {}))
  local whole = frame_pixels(subject)
  local floats = { depth = "float", colour = "linear", alpha = "premultiplied" }
  if whole:bytes(floats) == rest:bytes(floats) then
    return false, ("cel %q is not visible in frame %d: the frame is the same without it"):format(
      subject.name, subject.frame)
  end
  return true, ("cel %q is visible in frame %d, and it should not be: the frame changes without "
    .. "it"):format(subject.name, subject.frame)
end

--- The mean matte of the cel, without its back light.
local function matte_of(subject)
  local function alone(cel)
    return cel.name == subject.name and cel:with { back = { 0, 0, 0, 0 } } or nil
  end
  local image = pixels_of(changed_film(subject, alone, { back = { 0, 0, 0, 0 } }))
  local bytes, sum = image:bytes { depth = 8, colour = "linear", alpha = "straight" }, 0
  for alpha in bytes:gmatch "...(.)" do sum = sum + alpha:byte() end
  return sum / 255 / (image.width * image.height)
end

function claims.covers(subject, arguments)
  local share = arguments[1]
  if not fields.is_finite(share) or share < 0 or share > 1 then
    refuse("covers takes a share of the frame, a number from 0 to 1, got " .. fields.shown(share))
  end
  local found = matte_of(subject)
  local place = ("cel %q covers %.4g of frame %d"):format(subject.name, found, subject.frame)
  if found < share then return false, ("%s, not %.4g of it or more"):format(place, share) end
  return true, ("%s, and it should cover less than %.4g"):format(place, share)
end

function claims.look_alike(subject, _)
  local function image_of(frame) return pixels_of(subject.film, { frame = frame }) end
  local first = image_of(subject.frames[1])
  for i = 2, #subject.frames do
    local found = difference_of(first, image_of(subject.frames[i]), ONE_CODE)
    if found.count > 0 then
      return false,
        ("frames %d and %d do not look alike: %d of %d pixels differ;\n  most by %s codes "
        .. "of 8 bits, at x %d, y %d, channel %s"):format(subject.frames[1], subject.frames[i],
        found.count, first.width * first.height, code(found.largest), found.x, found.y,
        found.channel)
    end
  end
  return true, ("frames %s look alike, and they should not"):format(
    table.concat(subject.frames, ", "))
end

local span_kinds = { "single", "gradient", "array" }

function claims.holds(subject, arguments)
  local wanted = arguments[1]
  check("holds", wanted, { single = "number", gradient = "number", array = "number" })
  if next(wanted) == nil then
    refuse("holds takes counts of spans: single =, gradient =, array =")
  end
  local y = subject.y
  local rows, message = celspan.spans(subject.film, { frame = subject.frame, rows = { y, y } })
  need(rows, message)
  local found, is_so, told, asked = { single = 0, gradient = 0, array = 0 }, true, {}, {}
  for _, span in ipairs(rows[y]) do found[span.kind] = found[span.kind] + 1 end
  for _, kind in ipairs(span_kinds) do
    if wanted[kind] then
      is_so = is_so and found[kind] == wanted[kind]
      asked[#asked + 1] = ("%s = %.14g"):format(kind, wanted[kind])
    end
    told[#told + 1] = ("%s = %d"):format(kind, found[kind])
  end
  local place = ("row %d of frame %d holds spans { %s }"):format(y, subject.frame,
    table.concat(told, ", "))
  if is_so then return true, place .. ", and it should not" end
  return false, ("%s, not { %s }"):format(place, table.concat(asked, ", "))
end

-- ---------------------------------------------------------------- luassert

--- The word for the subject of each claim.
local about = { looks_like = "frame", shows = "point", visible = "cel", covers = "cel",
                look_alike = "frames", holds = "row" }
local takes = { frame = "film, n", point = "film, n, x, y", cel = "film, n, name",
                frames = "film, m, n", row = "film, n, y" }

say:set("assertion.celspan", "%s")

-- busted reports the line of the first function on the stack that is neither in C nor in luassert.
-- native.outside removes this function from the stack, so the reported line is in the spec.
for word, read in pairs(subjects) do
  luassert:register("modifier", word, native.outside(function(state, arguments)
    if not arguments then
      refuse(("write assert.%s(%s).claim(...): these are the arguments of %s"):format(word,
        takes[word], word))
    end
    rawset(state, "celspan", read(arguments))
    return state
  end))
end

--- Replaces the arguments by the message, because they are not shown.
local function set_message(arguments, message)
  if type(message) == "function" then message = message() end
  for i = 1, arguments.n do arguments[i] = nil end
  arguments[1], arguments.n, arguments.nofmt = message, 1, { true }
end

for word, claim in pairs(claims) do
  luassert:register("assertion", word, native.outside(function(state, arguments)
    local subject = rawget(state, "celspan")
    if not subject or subject.word ~= about[word] then
      refuse(("%s applies to a %s: assert.%s(%s).%s(...)"):format(word, about[word], about[word],
        takes[about[word]], word))
    end
    local holds, message = claim(subject, arguments)
    if holds ~= rawget(state, "mod") then set_message(arguments, message) end
    return holds
  end), "assertion.celspan", "assertion.celspan")
end

spec.assert = luassert

return fields.seal("spec", spec)
