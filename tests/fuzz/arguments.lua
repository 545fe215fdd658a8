--- Any bytes as a script that calls the functions of celspan: the constructors, with the fields
--- that they document and the types that the annotations for editors give these, the methods, the
--- operators, and the animation library; each value is right, of another kind, at an edge, or one
--- whose metamethods fail. The values made are rendered in a frame of few pixels, as spans and by
--- points.
---
--- A call returns, or raises a sentence: with the position of the call, of one line and readable
--- length, and about its arguments, not about the inside of the library.
local celspan = require "celspan"
local annotations = require "tests.fuzz.annotations"

local target = {}

local MOST_CALLS = 24
local MOST_MESSAGE = 2000

-- ---------------------------------------------------------------- choices

local bytes, at

--- A number from 0 to n - 1; 0 when no bytes are left.
local function take(n)
  local value = bytes:byte(at) or 0
  at = at + 1
  return value % n
end

local function one_of(list) return list[take(#list) + 1] end

--- Whether the next choice falls on one of n.
local function happens(n) return take(n) == n - 1 end

local edges = { 0 / 0, math.huge, -math.huge, 1e300, -1e300, math.mininteger, math.maxinteger,
  1e-320, -0.0,
                2 ^ 31, 2 ^ 32, 2 ^ 53, 0.5, -1, 1e12, 1.0000001e12 }

local function number()
  if happens(8) then return one_of(edges) end
  local scale = ({ 1, 1, 0.1, 1, 10, 1 / 255, 100, 1e6 })[take(8) + 1]
  return (take(256) - 32) * scale
end

local function integer()
  if happens(8) then return one_of(edges) end
  return take(20)
end

-- ---------------------------------------------------------------- what resists

local NASTY = setmetatable({}, { __tostring = function() return "a nasty error" end })
local huge_text = ("x"):rep(1 << 20)

local function raise() error(NASTY) end

--- Functions that may run inside a call, and what they return or do there.
local resisting = {
  raise,
  function() error("a nasty error", 0) end,
  function() return coroutine.yield(1) end,
  function() return 0 / 0 end,
  function() return {} end,
  function() return "x" end,
  function() return nil end,
  function(...) return ... end,
  function() return celspan.pixels(celspan.rostrum {}, { size = { 2, 2 } }) end,
  function() collectgarbage() return 1 end,
}

local function metatables()
  local f = one_of(resisting)
  return { __index = f, __newindex = f, __len = f, __pairs = f, __call = f, __tostring = f,
    __eq = f, __lt = f,
           __gc = happens(4) and f or nil, __close = f,
           __name = happens(3) and f or "celspan.object" }
end

local function cyclic()
  local t = { 1, 2 }
  t[3], t.texture, t.points = t, t, t
  return t
end

local pool -- values that were made, the latest last

local wrong = {
  function() return nil end,
  function() return take(2) == 1 end,
  number,
  function()
    return one_of { "", "x", "#fff", "#zzz", "a\0b", "\27[31m\n", "\255\254", "area", huge_text,
      "1", "nan" }
  end,
  function() return {} end,
  cyclic,
  function() return setmetatable({ 1, 2, 3 }, metatables()) end,
  function() return one_of(resisting) end,
  function() return io.stdout end,
  function() return coroutine.create(raise) end,
  function() return pool[take(#pool + 1)] end,
  function() return celspan end,
  function() return { [1] = 1, [3] = 3 } end,
  function() return { [2 ^ 53] = 1, [NASTY] = 2 } end,
  function() return math.mininteger end,
}

-- ---------------------------------------------------------------- values of a type

local value

--- A list of values of a type; sometimes of a length that is not `count`.
local function list(type_name, count, depth)
  local made = {}
  if happens(12) then count = one_of { 0, 1, 2, 5, 40 } end
  for i = 1, count or take(5) do made[i] = value(type_name, depth + 1) end
  if type_name == "stop" then -- they ascend
    for i, stop in ipairs(made) do
      if type(stop) == "table" and type(stop[1]) == "number" then
        stop[1] = (i - 1 + stop[1]) / #made
      end
    end
  end
  return made
end

local words = { string = { "x", "a.png", "M1 1L7 2 3 7z", "#fa0", "en", "scripts/type/block.ttf",
  "1-3", "out.png" } }

--- Value formats that the annotations describe only in sentences, by class or constructor.
local items = {
  ["celspan.gradient"] = { count = 3, item = "corner" },
  ["celspan.linear.fields"] = { count = 2, item = "stop" },
  ["celspan.radial.fields"] = { count = 2, item = "stop" },
  ["celspan.conic.fields"] = { count = 2, item = "stop" },
  ["celspan.rect.fields"] = { count = 4, item = "number" },
  ["celspan.triangle.fields"] = { count = 3, item = "celspan.point" },
  ["celspan.polygon.fields"] = { count = 4, item = "celspan.point" },
}
local counts = { ["celspan.point"] = 2, size = 2, film = 2, crop = 4, bounds = 4, viewport = 4,
  box = 4, source = 4,
                 matrix = 9, radii = 2, taper = 2, rows = 2, pigment = 3, medium = 3, points = 5 }

--- The fields of a class, from its table of annotations, each of them present or not.
local function fields_of(class, depth)
  local made = {}
  local shape = items[class]
  local list_type = shape and shape.item or annotations.item(class)
  if list_type then made = list(list_type, shape and shape.count, depth) end
  for _, field in ipairs(annotations.fields(class)) do
    if not field.is_optional and not happens(16) or happens(4) then
      made[field.name] = value(field.type, depth + 1, field.name)
    end
  end
  if happens(24) then made[one_of { "raduis", "x", 1.5, true }] = value("number", depth) end
  return made
end

local function of_kind(kind)
  for i = #pool - take(4), 1, -1 do
    if tostring(pool[i]):find("^" .. kind) then return pool[i] end
  end
end

local call

local function make(constructor, class, depth)
  return call("celspan." .. constructor, celspan[constructor], fields_of(class, depth))
end

--- A rostrum, a film, an object, ...: one made before, or something plain.
local values = {
  ["celspan.paint"] = function() return celspan.rgb(take(256) / 255, 0.5, 0, take(3) / 2) end,
  ["celspan.texture"] = function(depth) return make("linear", "celspan.linear.fields", depth) end,
  ["celspan.object"] = function()
    return of_kind "circle" or of_kind "union"
      or celspan.circle { centre = { take(9), take(9) }, radius = take(9) }
  end,
  ["celspan.cel"] = function()
    return of_kind "cel"
      or celspan.cel { celspan.rect { 1, 1, take(9), take(9), texture = "#80ff00" } }
  end,
  ["celspan.rostrum"] = function()
    return of_kind "rostrum"
      or celspan.rostrum { back = "#fff", celspan.cel { celspan.rect { 0, 0, 3, take(9) } } }
  end,
  ["celspan.film"] = function()
    return of_kind "film" or celspan.film { size = { 4, 4 }, frames = 3, frame = function()
      return celspan.rostrum {}
    end }
  end,
  ["celspan.frame"] = function() return of_kind "frame" or 1 end,
  corner = function(depth) return { take(9), take(9), value("celspan.colour", depth + 1) } end,
  stop = function(depth) return { take(5) / 4, value("celspan.colour", depth + 1) } end,
  number = number,
  integer = integer,
  boolean = function() return take(2) == 1 end,
  string = function() return one_of(words.string) end,
  table = function(depth) return list("number", nil, depth) end,
  any = function(depth) return value("celspan.object", depth + 1) end,
}

--- A function that returns what the annotation says, or resists.
local function callback(answer, depth)
  if happens(6) then return one_of(resisting) end
  local answers = {}
  for i = 1, 2 do answers[i] = answer and value(answer, depth + 1) or nil end
  return function(given)
    if given ~= nil and #pool < 64 then pool[#pool + 1] = given end
    return answers[take(2) + 1]
  end
end

--- A value of a type of the annotations, or now and then something else.
function value(type_name, depth, name)
  depth = depth or 0
  if depth > 8 then return take(9) end
  if happens(20) then return one_of(wrong)() end
  local kind, inner = annotations.parse(type_name, take)
  if kind == "word" then return inner end
  if kind == "list" then return list(inner, counts[name] or counts[type_name], depth) end
  if kind == "function" then return callback(inner, depth) end
  if kind == "class" then return fields_of(inner, depth) end
  if counts[type_name] then return list("number", counts[type_name], depth) end
  return (values[inner] or one_of(wrong))(depth)
end

-- ---------------------------------------------------------------- calls

--- This file as positions name it: the folder that the project is in may have the library's name.
local HERE = (debug.getinfo(1, "S").short_src:gsub("%p", "%%%0")) .. ":%d+:"

local function is_sentence(message)
  if message == NASTY or message == "a nasty error" then return true end
  if type(message) ~= "string" then return false, "an error that is not a string" end
  if #message > MOST_MESSAGE then return false, "a message longer than a page" end
  local said = message:gsub(HERE, "")
  for _, inside in ipairs { "attempt to ", "bad argument", "celspan/[%l_/]+%.lua:", "celspan broke",
    "stack overflow" } do
    if said:find(inside) and not message:find "nasty" then
      return false, "a message about the inside"
    end
  end
  if message:find "[%z\1-\9\11-\31\127]" then return false, "control characters in a message" end
  return true
end

--- Messages that Lua itself raises where a callback yields or a hook ends the run.
local function is_of_lua(message)
  return type(message) == "string"
    and (message:find "yield across" or message:find "yield from outside"
    or message:find "not enough memory" or message:find "memory"
    or message:find "more than %d+ steps")
end

--- Not as a tail call, so that messages can include its line.
local function invoke(f, ...)
  local results = table.pack(f(...))
  return table.unpack(results, 1, results.n)
end

--- Calls; raises an error if the result breaks a promise; else returns the result, or nothing.
function call(what, f, ...)
  local results = table.pack(pcall(invoke, f, ...))
  local message
  if not results[1] then message = results[2] end
  if results[1] and results[2] == nil and type(results[3]) == "string" then message = results[3] end
  if message ~= nil and not is_of_lua(message) then
    local good, why = is_sentence(message)
    if good and not results[1] and type(message) == "string" and not message:find "nasty" then
      good, why = message:find("^[^\n]-:%d+: ") ~= nil, "a message without the position of the call"
    end
    if not good then error(("%s: %s: %s"):format(what, why, tostring(message):sub(1, 500)), 0) end
  end
  if not results[1] then return nil end
  for i = 2, results.n do
    local v = results[i]
    if v ~= nil and type(v) ~= "string" and type(v) ~= "boolean" and #pool < 64 then
      pool[#pool + 1] = v
    end
  end
  return results[2]
end

local constructors = annotations.functions()
for _, f in ipairs(constructors) do
  if f.name == "gradient" then f.types = { "celspan.gradient" } end
end
local modules = {}
for _, name in ipairs { "ease", "keys", "motion", "multiplane", "shutter", "lips", "sheet", "svg",
  "trace", "track",
                        "layers", "json" } do
  modules[#modules + 1] = { name = name, module = require("celspan." .. name) }
end

--- The arguments of the library's functions, in the notation of the annotations.
local library = {
  ease = { { "", "string" } },
  keys = { { "", "key_list" } },
  motion = { { "along", "celspan.point[]" }, { "along", "string" },
    { "wiggle", "string", "wiggle" } },
  multiplane = { { "", "plane_list" } },
  shutter = { { "", "shutter" } },
  lips = { { "read", "string", "table" } },
  sheet = { { "new", "sheet" }, { "read", "string", "table" }, { "of", "celspan.film", "table" } },
  svg = { { "read", "string", "table" } }, trace = { { "picture", "string", "table" } },
  track = { { "read", "string" }, { "follow", "string", "table" } },
  layers = { { "read", "string" } },
  json = { { "decode", "string" } },
}
function values.key_list(depth)
  local made_keys = { loop = happens(3) and one_of { "repeat", "mirror", "x" } or nil }
  local kind = one_of { "number", "celspan.point", "celspan.colour", "string" }
  for i = 1, take(5) do
    made_keys[i] = { i - 1, value(kind, depth + 1), happens(3)
      and one_of { "inOutQuad", "steps:4", "bezier:0,0,1,1", "no" } or nil }
  end
  return made_keys
end
function values.plane_list(depth)
  local planes = { film = { 8, 8 }, camera = { x = number(), z = number() },
    focal = happens(3) and number() or nil,
                   focus = happens(3) and number() or nil, aperture = happens(3) and take(9) or nil,
                   fit = happens(2) }
  for i = 1, take(4) do planes[i] = { value("celspan.cel", depth + 1), z = number() } end
  return planes
end
function values.shutter(depth)
  return { angle = happens(2) and number() or nil, samples = take(6),
    frame = callback("celspan.exposures", depth) }
end
function values.wiggle() return { frequency = number(), amplitude = number() } end
function values.sheet(depth)
  return { fps = happens(2) and number() or nil, frames = happens(2) and integer() or nil,
    layers = { "A", "B" },
           drawings = { A = { [take(9)] = "1", [take(9)] = value("string", depth + 1) }, B = {} },
           marks = { A = { [take(9)] = "key" } },
           notes = { { kind = "dialogue", from = take(9), to = take(9), text = "x" } } }
end

local function arguments(types, first)
  local made_arguments = {}
  for i = first, #types do made_arguments[#made_arguments + 1] = value(types[i], 1) end
  if happens(12) then made_arguments[#made_arguments + 1] = one_of(wrong)() end
  return made_arguments
end

--- Functions that read or write files are called only with names from here.
local function call_constructor()
  local f = one_of(constructors)
  if f.name == "render" then return end
  local given = arguments(f.types, 1)
  call("celspan." .. f.name, celspan[f.name], table.unpack(given, 1, #f.types + 1))
end

local function call_library()
  local entry = one_of(modules)
  local f = one_of(library[entry.name])
  local given = arguments(f, 2)
  if f[1] == "" then
    call("celspan." .. entry.name, entry.module, table.unpack(given, 1, #f))
  else
    call(("celspan.%s.%s"):format(entry.name, f[1]), entry.module[f[1]], table.unpack(given, 1, #f))
  end
end

local methods = annotations.methods()

local function call_method()
  local subject = pool[#pool - take(6)]
  local f = one_of(methods)
  if type(subject) ~= "userdata" and type(subject) ~= "table" or f.name == "write" then return end
  if getmetatable(subject) == nil then return end
  local is_there, method = pcall(function() return subject[f.name] end)
  if not is_there or type(method) ~= "function" then return end
  if happens(16) then subject = one_of(wrong)() end
  call(":" .. f.name, method, subject, table.unpack(arguments(f.types, 1), 1, #f.types + 1))
end

local operators = {
  function(a, b) return a | b end, function(a, b) return a & b end, function(a, b) return a ~ b end,
  function(a, b) return a - b end, function(a) return #a end, function(a) return tostring(a) end,
  function(a, b) return a == b end, function(a, b) return a[b] end, function(a, b) a[b] = 1 end,
  function(a, b) return a .. b end, function(a, b) return a < b end,
  function(a) return pairs(a)(a) end,
  function(a) return getmetatable(a) end,
  function(a, b) return setmetatable(a, { __index = b }) end,
  function(a) return debug.setmetatable and rawlen(a) end,
}

--- If celspan does not define an operator, Lua's own message is right.
local function apply_operator()
  local a, b = pool[#pool - take(4)], happens(2) and one_of(wrong)() or pool[#pool - take(4)]
  local good, result = pcall(one_of(operators), a, b)
  if good and type(result) == "userdata" then pool[#pool + 1] = result end
end

local function look()
  local what = of_kind "rostrum" or of_kind "film"
  if not what or getmetatable(what) == "celspan.object" then
    -- a rostrum that was moved is an object
    local object = what or of_kind "%l"
    local good, made_rostrum = pcall(function()
      return celspan.rostrum { celspan.cel { object } }
    end)
    if not good then return end
    what = made_rostrum
  end
  local options = { size = { 1 + take(8), 1 + take(8) }, film = { 8, 8 }, workers = 1,
    antialias = one_of { "area", "none" } }
  if happens(3) then
    options.antialias = { kernel = one_of { "box", "gaussian", "mitchell", "lanczos" },
      radius = take(4) }
  end
  local image = call("celspan.pixels", celspan.pixels, what, options)
  if type(image) == "userdata" then
    local _, _, _, a = image:get(0, 0)
    assert(a >= 0 and a <= 1, "an alpha beyond 0 to 1")
  end
  call("celspan.spans", celspan.spans, what, options)
  local r, message = celspan.probe(what, take(9), take(9), { film = { 8, 8 } })
  assert(type(r) == "number" and r == r or type(message) == "string",
    "a point without a colour or a sentence")
end

local actions = { call_constructor, call_constructor, call_constructor, call_method, call_method,
  call_library,
                  apply_operator, look }

function target.try_bytes(given)
  bytes, at, pool = given, 1, {}
  for _ = 1, MOST_CALLS do
    if at > #bytes then break end
    local ran, problem = pcall(one_of(actions))
    if not ran and not is_of_lua(problem) and problem ~= NASTY and problem ~= "a nasty error" then
      error(problem, 0)
    end
  end
  look()
  pool = nil
end

return target
