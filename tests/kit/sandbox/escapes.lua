--- Ways out of the sandbox that must be closed.
---
--- Each is a name, a chunk, and a pattern that its result must contain. A chunk that escapes
--- returns true; the result of any other is its return value, or the error that it raises. SECRET
--- is a file next to the script's folder, LINK a link to it inside, OUT a file that does not exist,
--- BESIDE the folder above the script's.
return {
  -- globals that are not there
  { "io", [[return io.open(SECRET) ~= nil]], "io is not in the sandbox" },
  { "io by rawget", [[return rawget(_G, "io") ~= nil and true or "none"]], "none" },
  { "os", [[return os.execute("true") ~= nil]], "os is not in the sandbox" },
  { "os.getenv", [[return os.getenv("HOME") ~= nil]], "os is not in the sandbox" },
  { "debug", [[return debug.getregistry() ~= nil]], "debug is not in the sandbox" },
  { "package", [[return package.loadlib ~= nil]], "package is not in the sandbox" },
  { "package.loaded", [[return package.loaded.io ~= nil]], "package is not in the sandbox" },
  { "dofile", [[return dofile(SECRET) or true]], "dofile is not in the sandbox" },
  { "loadfile", [[return loadfile(SECRET) ~= nil]], "loadfile is not in the sandbox" },
  { "collectgarbage", [[return collectgarbage("count") > 0]], "collectgarbage is not" },
  { "warn", [[warn("@on") return true]], "warn is not in the sandbox" },
  { "string.dump", [[return string.dump(function() end) ~= nil]], "attempt to call a nil value" },
  { "dump as a method", [[return (""):dump() ~= nil]], "attempt to call a nil value" },
  { "coroutine.close", [[coroutine.close(coroutine.create(print)) return true]], "nil value" },
  { "other globals", [[
    local known = {}
    for name in ("assert error ipairs pairs next pcall xpcall select tonumber tostring type "
      .. "rawequal rawlen rawget rawset setmetatable getmetatable load require print coroutine "
      .. "math string table utf8 _G _VERSION"):gmatch("%S+") do known[name] = true end
    local names = {} for name in pairs(_G) do if not known[name] then names[#names + 1] = name end
      end
    for name in pairs(known) do if rawget(_G, name) == nil then names[#names + 1] = "-" .. name end
      end
    table.sort(names)
    return #names > 0 and table.concat(names, " ") or "the list"]], "^the list$|^player$" },
  { "other names in string", [[local names = {} for name in pairs(string) do names[#names +
    1] = name end
    return table.concat(names, " ")]],
    "^byte char find format gmatch gsub len lower match pack packsize rep reverse sub "
      .. "unpack upper$" },
  { "other names in table", [[local names = {} for name in pairs(table) do names[#names +
    1] = name end
    return table.concat(names, " ")]], "^concat insert move pack remove sort unpack$" },
  { "other names in coroutine", [[local names = {} for name in pairs(coroutine) do
    names[#names + 1] = name end
    return table.concat(names, " ")]], "^create isyieldable resume running status wrap yield$" },
  { "other names in utf8", [[local names = {} for name in pairs(utf8) do names[#names + 1]
    = name end
    return table.concat(names, " ")]], "^char charpattern codepoint codes len offset$" },
  { "other names in math", [[local names = {} for name in pairs(math) do names[#names + 1]
    = name end
    return table.concat(names, " ")]],
      "^abs acos asin atan ceil cos deg exp floor fmod huge log max "
    .. "maxinteger min mininteger modf pi rad random randomseed sin sqrt tan tointeger type ult$" },

  -- code that brings other globals
  { "load sees the sandbox", [[return load("return io")() ~= nil]], "io is not in the sandbox" },
  { "load of an environment", [[return load("return io", "x", "t", {})() == nil and "none"]],
    "^none$" },
  { "load of _ENV", [[local _ENV = { load = load } return load("return io")()]], "io is not in" },
  { "load from a function",
    [[local n = 0 return load(function() n = n + 1 return ({ "return ", "io" })[n] end)()]],
    "io is not in the sandbox" },
  { "bytecode", [[return load("\27Lua\x54\0\x19\x93\r\n\x1a\n") ~= nil]],
    "%(a nil value%)$|false" },
  { "bytecode by mode", [[local f, why = load("\27Lua", "x", "b") return f ~= nil or why]],
    "loads only text" },
  { "bytecode by both modes", [[local f, why = load("\27Lua", "x", "bt") return f ~= nil or why]],
    "binary chunk" },
  { "a global that has no name", [[return _G[1] ~= nil or "none"]], "^none$" },
  { "setfenv", [[return setfenv ~= nil or "none"]], "^none$" },
  { "an upvalue of a function of celspan",
    [[return getmetatable(require("celspan.ease")) ~= "celspan" or "celspan"]],
    "^celspan$" },

  -- modules
  { "require io", [[return require("io") ~= nil]], "module 'io' not found" },
  { "require os", [[return require("os") ~= nil]], "module 'os' not found" },
  { "require debug", [[return require("debug") ~= nil]], "module 'debug' not found" },
  { "require package", [[return require("package") ~= nil]], "module 'package' not found" },
  { "require _G", [[return rawget(require("_G"), "io") ~= nil or "none"]], "^none$" },
  { "require string", [[return require("string").dump ~= nil or "none"]], "^none$" },
  { "require coroutine", [[return require("coroutine").close ~= nil or "none"]], "^none$" },
  { "require celspan.native", [[return require("celspan.native") ~= nil]],
    "celspan.native' is private" },
  { "require celspan.spec", [[return require("celspan.spec") ~= nil]],
    "celspan.spec' is not in the sandbox" },
  { "require of what celspan has not", [[return require("celspan.nothing") ~= nil]],
    "module 'celspan.nothing' not found" },
  { "require of a module that gives nothing",
    [[return tostring(require("silent")) .. tostring(require("silent"))]],
    "^truetrue$" },
  { "require above", [[return require("../beside") == "escaped"]], "not found" },
  { "require above by points", [[return require("...beside") == "escaped"]], "not found" },
  { "require by an absolute name", [[return require(BESIDE .. "/beside") == "escaped"]],
    "not found" },
  { "require through a link", [[return require("linked") == "escaped"]], "not found" },
  { "require through a linked folder", [[return require("around.beside") == "escaped"]],
    "not found" },
  { "require of a native module", [[return require("native") ~= nil]], "not found" },
  { "require of bytecode", [[return require("compiled") ~= nil]], "error loading module" },
  { "require of a huge module", [[return require("huge") ~= nil]], "more than 16 MiB" },
  { "a module's globals", [[return require("inner") ~= nil]], "io is not in the sandbox" },
  { "a pipe as module", [[return require("pipe") ~= nil]], "not found" },
  { "preload", [[require("_G").package = { preload = { x = 1 } } return require("x") ~= nil]],
    "not found" },

  -- files that celspan reads
  { "a picture", [[return celspan.picture{ file = SECRET } ~= nil]],
    "can read only files in" },
  { "a picture above", [[return celspan.picture{ file = "../secret.txt" } ~= nil]],
    "can read only files in" },
  { "a picture by a link", [[return celspan.picture{ file = LINK } ~= nil]],
    "can read only files in" },
  { "a picture by a linked folder", [[return celspan.picture{ file = "around/secret.txt" } ~= nil]],
    "can read only files in" },
  { "a picture that does not exist",
    [[return celspan.picture{ file = BESIDE .. "/no/such.png" } ~= nil]],
    "can read only files in" },
  { "a picture in a folder of the same beginning",
    [[return celspan.picture{ file = "../scriptsother/x.png" } ~= nil]],
    "can read only files in" },
  { "a picture of a long name", [[return celspan.picture{ file = ("x/"):rep(3000) } ~= nil]],
    "can read only files in" },
  { "a picture of no folder", [[return celspan.picture{ file = "/no-such" } ~= nil]],
    "can read only files in" },
  { "an image", [[return celspan.image{ file = SECRET } ~= nil]], "can read only files in" },
  { "a picture by with",
    [[return celspan.picture{ file = "there.png" }:with{ file = SECRET } ~= nil]],
    "can read only files in" },
  { "a font", [[return celspan.text{ "x", font = SECRET } ~= nil]], "can read only files in" },
  { "a font in a list", [[return celspan.text{ "x", font = { "there.ttf", SECRET } } ~= nil]],
    "can read only files in" },
  { "a drawing", [[return require("celspan.svg").read(SECRET) ~= nil]], "can read only files in" },
  { "a font of a drawing",
    [[return require("celspan.svg").read("there.svg", { fonts = { default = SECRET } }) ~= nil]],
    "can read only files in" },
  { "layers", [[return require("celspan.layers").read(SECRET) ~= nil]], "can read only files in" },
  { "layers of a folder", [[return require("celspan.layers").read(BESIDE) ~= nil]],
    "can read only files in" },
  { "layers of a linked folder", [[return require("celspan.layers").read("around") ~= nil]],
    "can read only files in" },
  { "an exposure sheet", [[return require("celspan.sheet").read(SECRET) ~= nil]],
    "can read only files in" },
  { "a sheet's drawings", [[
    local s = require("celspan.sheet").new{ fps = 24, frames = 1, layers = { "a" }, drawings = { a =
      { "1" } } }
    return s:drawing("a", 1, "../secret_#.png") ~= nil]], "can read only files in" },
  { "lips", [[return require("celspan.lips").read(SECRET) ~= nil]], "can read only files in" },
  { "a device", [[return celspan.picture{ file = "/dev/zero" } ~= nil]],
    "can read only files in" },
  { "the environment of a process",
    [[return celspan.picture{ file = "/proc/self/environ" } ~= nil]],
    "can read only files in" },
  { "a name with a zero",
    [[return celspan.picture{ file = "there.png\0/../../secret.txt" } ~= nil]], "." },
  { "a chunk's name as folder", [[return load("return celspan.picture{ file = 'secret.txt' }",
    "@" .. BESIDE .. "/x.lua", "t", { celspan = celspan })() ~= nil]], "can read only files in" },
  { "a chunk named as celspan's own", [[return
    load("return celspan.picture{ file = '../secret.txt' }",
    "@celspan/x.lua", "t", { celspan = celspan })() ~= nil]], "can read only files in" },

  -- files that celspan writes
  { "render", [[return assert(celspan.render(FILM, OUT))]], "cannot write files" },
  { "render into the folder", [[return assert(celspan.render(FILM, "out.png"))]],
    "cannot write files" },
  { "image:write", [[return assert(celspan.pixels(FILM):write(OUT))]], "cannot write files" },
  { "image:write into the folder", [[return assert(celspan.pixels(FILM):write("out.png"))]],
    "cannot write files" },
  { "image:write of another format",
    [[return assert(celspan.pixels(FILM):write(OUT, { format = "tga" }))]],
    "cannot write files" },
  { "sheet:write",
    [[return assert(require("celspan.sheet").new{ fps = 24, frames = 1, layers = {} ]]
    .. [[}:write("x.csv"))]],
    "cannot write files" },
  { "replacing the script", [[return assert(celspan.pixels(FILM):write("script.lua"))]], "." },

  -- metatables
  { "texts' metatable", [[return type(getmetatable("")) == "table" or getmetatable("")]],
    "^string$" },
  { "texts' methods",
    [[string.rep = function() return "changed" end return ("x"):rep(2) ~= "xx" or "kept"]],
    "^kept$" },
  { "texts' index", [[return getmetatable("").__index ~= nil and true or "none"]], "^none$" },
  { "__gc", [[setmetatable({}, { __gc = print }) return true]], "__gc is not in the sandbox" },
  { "__gc as false", [[setmetatable({}, { __gc = false }) return true]],
    "__gc is not in the sandbox" },
  { "__gc set later", [[local ran local mt = {} local t = setmetatable({}, mt) mt.__gc = function()
    ran = true end
    t = nil for _ = 1, 200 do local x = ("x"):rep(100000) end return ran or "never"]], "^never$" },
  { "__mode", [[setmetatable({}, { __mode = "k" }) return true]], "__mode is not in the sandbox" },
  { "__mode set later", [[local mt = {} local t = setmetatable({}, mt) mt.__mode = "v" t[1] = {}
    for _ = 1, 200 do local x = ("x"):rep(100000) end return t[1] == nil or "strong"]], "^strong$"
      },
  { "__mode of a metatable's metatable", [[local mt, mm = {}, {} setmetatable(mt, mm) mm.__mode =
    "v"
    local t = setmetatable({}, mt) mt.__index = {} return getmetatable(getmetatable(t)) ~= mm or
      "kept"]], "^kept$" },
  { "a protected metatable", [[local t = setmetatable({}, { __metatable = "mine" })
    return pcall(setmetatable, t, {}) or getmetatable(t)]], "^mine$" },
  { "a value's metatable",
    [[return type(getmetatable(celspan.rgb(1, 1, 1))) == "table" or "closed"]], "^closed$" },
  { "a value's metatable set", [[setmetatable(celspan.rgb(1, 1, 1), {}) return true]],
    "table expected" },
  { "the metatable of celspan", [[return type(getmetatable(celspan)) == "table" or "closed"]],
    "^closed$" },
  { "the metatable of a track", [[local t = require("celspan.keys"){ { 0, 1 }, { 1, 2 } }
    return type(getmetatable(t)) == "table" or "closed"]], "^closed$" },
  { "a metatable of celspan's replaced", [[setmetatable(celspan, {}) return true]],
    "protected metatable" },
  { "the hidden copy by pairs",
    [[local mt = {} setmetatable({}, mt) for k in pairs(mt) do return true end return "none"]],
    "^none$" },
  { "the hidden copy by next",
    [[local mt = {} setmetatable({}, mt) return next(mt) ~= nil or "none"]], "^none$" },
  { "a file's userdata", [[for _, v in pairs(require("celspan.sheet")) do if type(v) == "userdata"
    then return true end end
    return "none"]], "^none$" },
  { "a callable table as __call",
    [[setmetatable({}, { __call = setmetatable({}, { __call = print }) }) return true]],
    "__call must be a function" },

  -- addresses, the clock, other differences from run to run
  { "the address of a table", [[return tostring({}):find("0x", 1, true) ~= nil or tostring({})]],
    "^table$" },
  { "the address of a function", [[return tostring(print):find("0x", 1, true) ~= nil or "none"]],
    "^none$" },
  { "the address of a thread",
    [[return tostring(coroutine.create(print)):find("%x%x%x%x") ~= nil or "none"]], "^none$" },
  { "addresses by %p", [[return ("%p"):format({}) ~= nil]], "addresses differ in each run" },
  { "addresses by a wide %p", [[return ("%-20p"):format({}) ~= nil]],
    "addresses differ in each run" },
  { "addresses by %s",
    [[return ("%s %10.4s"):format({}, print):find("0x", 1, true) ~= nil or "none"]], "^none$" },
  { "addresses of values",
    [[return tostring(celspan.rgb(1, 1, 1)):find("0x", 1, true) ~= nil or "none"]], "^none$" },
  { "addresses of films", [[return tostring(FILM):find("0x", 1, true) ~= nil or "none"]],
    "^none$" },
  { "addresses in an error", [[local _, why = pcall(function() return {} < {} end)
    return why:find("0x", 1, true) ~= nil or "none"]], "^none$" },
  { "addresses as order", [[for k in pairs{ [{}] = 1 } do return true end]], "a key is a table" },
  { "addresses as order of next", [[return next{ [print] = 1 } ~= nil]], "a key is a function" },
  { "a seed from the clock", [[math.randomseed() return true]], "give a number" },
  { "random numbers", [[return ("%.17g"):format(math.random())]], "^0%.883310808213642" },
  { "random numbers of a range", [[local all = {}
    for i = 1, 12 do all[i] = math.random(i % 3 == 0 and 3 or -1, 3) end
    for _ = 1, 400 do local n = math.random(6) all[12 + n] = n end
    return table.concat(all, " ")]], "^[-0123 ]+ 1 2 3 4 5 6$" },
  { "random numbers of all integers", [[local low, high, negative = 0, 0, 0
    for _ = 1, 200 do
      local n = math.random(math.mininteger, (1 << 62) - 1) -- 3/4 of all: others are redrawn
      assert(n < 1 << 62)
      low = low + (n < -(1 << 62) and 1 or 0)
      negative = negative + (math.random(0) < 0 and 1 or 0)
      high = high + (math.random(math.mininteger, math.maxinteger) > 0 and 1 or 0)
    end
    return low > 45 and low < 85 and high > 60 and high < 140 and negative > 60 and negative < 140
      and "even"]], "^even$" },
  { "random numbers of a seed", [[local function draw(seed) math.randomseed(seed) return
    math.random(1 << 60) end
    return draw(1) == draw(1) and draw(1) ~= draw(2) and draw(1.5) == draw(1.5) and draw(1.5) ~=
      draw(1) and "the seed's"]],
    "^the seed's$" },
  { "the order of large numbers", [[local t, all = { [math.maxinteger] = "b", [0x1p63] = "c", [1 <<
    62] = "a" }, {}
    for _, v in pairs(t) do all[#all + 1] = v end
    for _, v in next, t do all[#all + 1] = v end
    return table.concat(all)]], "^abcabc$" },
  { "the order of next", [[local t, names = { b = 0, a = 0, ab = 0, [true] = 0, [false] = 0, [1] =
    0, [-1] = 0 }, {}
    for k in next, t do names[#names + 1] = tostring(k) end return table.concat(names, " ")]],
    "^%-1 1 a ab b false true$" },
  { "the order of pairs", [[local t = {} for i = 1, 9 do t["k" .. i] = i end t[2.5] = 0 t[true] = 0
    t[1] = 0
    local names = {} for k in pairs(t) do names[#names + 1] = tostring(k) end return
      table.concat(names, " ")]],
    "^1 2.5 k1 k2 k3 k4 k5 k6 k7 k8 k9 true$" },
  { "the order of a sort", [[local t = {} for i = 1, 300 do t[i] = { i, i % 3 } end
    table.sort(t, function(a, b) return a[2] < b[2] end) return t[1][1] .. " " .. t[100][1] .. " "
      .. t[300][1] ]],
    "^3 300 299$" },

  -- catching a limit
  { "a file kept by celspan", [[require("celspan.sheet").read("no.csv") return io ~= nil]],
    "io is not in" },
  { "a changed module", [[local sheet = require("celspan.sheet") sheet.new = function() return io
    end
    return rawget(_G, "io") ~= nil or "none"]], "^none$" },
  { "celspan's own globals",
    [[return require("celspan.json").read ~= nil and rawget(_G, "os") ~= nil or "none"]],
    "^none$" },
  { "a thread's globals", [[return coroutine.wrap(function() return io end)() ~= nil]],
    "io is not in" },
  { "xpcall's handler",
    [[local _, got = xpcall(error, function() return io end) return type(got) == ]]
    .. [["table" or "none"]],
    "^none$" },
  { "a replacement function", [[return ("x"):gsub(".", function() return io end) ~= nil]],
    "io is not in" },
  { "a reader that loads", [[return select(2, load(function() return io end))]], "io is not in" },
  { "a comparison that loads", [[table.sort({ 1, 2 }, function() return io end) return true]],
    "io is not in" },
  { "a scan-line procedure", [[celspan.pixels(celspan.rostrum{ celspan.cel{ celspan.scanline{ bounds
    = { 0, 0, 4, 4 },
    spans = function() leaked = io return nil end } } }, { size = { 4, 4 } }) return rawget(_G,
      "leaked") ~= nil or "none"]],
    "^none$" },
  { "a hidden key", [[local mt = {} setmetatable({}, mt) local seen for k in next, mt do seen = k
    end
    return seen ~= nil or "none"]], "^none$" },
}
