--- Scripts that never end, or need too many resources. Each is a name, a chunk, and the exit code:
--- 6 if a limit ends it, 3 if it is refused, 0 if it is harmless; and the limits, if the common
--- ones are too narrow.
return {
  -- loops
  { "a loop", [[while true do end]], 6 },
  { "goto", [[::again:: goto again]], 6 },
  { "repeat", [[repeat local x = 1 until false]], 6 },
  { "a long for", [[for i = 1, math.maxinteger do end]], 6 },
  { "recursion", [[local function f() return f() end f()]], 6 },
  { "deep recursion", [[local function f() return 1 + f() end f()]], 3, "--limit time=20" },
  { "a loop in pcall", [[pcall(function() while true do end end)]], 6 },
  { "a loop of pcalls", [[while true do pcall(function() while true do end end) end]], 6 },
  { "a loop of pcalls of errors", [[while true do pcall(error) end]], 6 },
  { "a loop in xpcall's handler", [[while true do
    xpcall(function() while true do end end, function() while true do end end) end]], 6 },
  { "a handler of an error", [[xpcall(error, function() while true do end end)]], 6 },
  { "a handler that fails", [[while true do xpcall(error, function() error() end) end]], 6 },
  { "a loop in a coroutine", [[coroutine.wrap(function() while true do end end)()]], 6 },
  { "a loop of coroutines",
    [[while true do coroutine.wrap(function() for i = 1, 900 do end end)() end]], 6 },
  { "a resumed loop",
    [[while true do coroutine.resume(coroutine.create(function() while true do end end)) end]], 6 },
  { "coroutines in coroutines",
    [[local function f() coroutine.wrap(f)() end while true do pcall(f) end]], 6 },
  { "yields",
    [[local co = coroutine.wrap(function() while true do coroutine.yield() end end) while true ]]
    .. [[do co() end]], 6 },
  { "__close",
    [[while true do local x <close> = setmetatable({}, { __close = function() while true do end ]]
    .. [[end }) end]], 6 },
  { "__close after a limit", [[local x <close> = setmetatable({}, { __close = function() while true
    do end end })
    while true do end]], 6 },
  { "__close that catches", [[local x <close> = setmetatable({}, { __close = function()
    while true do pcall(function() while true do end end) end end }) while true do end]], 6 },
  { "__index", [[local t = setmetatable({}, { __index = function(t, k) return t[k + 1] end }) while
    true do pcall(function()
    return t[1] end) end]], 6 },
  { "__eq", [[local m = { __eq = function() while true do end end }
    return setmetatable({}, m) == setmetatable({}, m)]], 6 },
  { "__concat", [[return setmetatable({}, { __concat = function() while true do end end }) .. "x"]],
    6 },
  { "__tostring",
    [[return tostring(setmetatable({}, { __tostring = function() while true do end end }))]], 6 },
  { "__pairs",
    [[for _ in pairs(setmetatable({}, { __pairs = function() return function() return 1 end end ]]
    .. [[})) do end]], 6 },
  { "an error that prints itself",
    [[error(setmetatable({}, { __tostring = function() while true do end end }))]], 3 },

  -- single calls of C
  { "table.move", [[table.move({}, 1, 1 << 52, 2)]], 3 },
  { "table.move within the bound", [[local t = {} while true do table.move(t, 1, 9999999, 2) end]],
    6 },
  { "table.insert",
    [[table.insert(setmetatable({}, { __len = function() return 1 << 52 end }), 1, 0)]], 3 },
  { "table.remove",
    [[table.remove(setmetatable({}, { __len = function() return 1 << 52 end }), 1)]], 3 },
  { "table.concat", [[table.concat({}, "", 1, 1 << 52)]], 3 },
  { "table.concat of made up items",
    [[table.concat(setmetatable({}, { __index = function() while true do end end }), "", 1, 2)]],
    6 },
  { "table.unpack", [[table.unpack({}, 1, 1 << 52)]], 3 },
  { "table.unpack of many", [[table.unpack({}, 1, 2000000)]], 3 },
  { "table.sort", [[table.sort({ 1, 2, 3 }, function() while true do end end)]], 6 },
  { "table.sort of a made up length",
    [[table.sort(setmetatable({}, { __len = function() return 1 << 40 end }))]], 3 },
  { "a sort that never agrees", [[local t = {} for i = 1, 50000 do t[i] = i end
    while true do table.sort(t, function(a, b) return true end) end]], 6 },
  { "string.rep of nothing", [[assert(string.rep("", 1 << 60) == "")]], 0 },
  { "string.rep", [[return ("x"):rep(1 << 40)]], 3 },
  { "string.rep, often", [[while true do local x = ("x"):rep(10000000) end]], 6 },
  { "a pattern", [[("a"):rep(300):find(("a-"):rep(8) .. "b")]], 6 },
  { "a pattern of points", [[("a"):rep(300):match((".-"):rep(12) .. "b")]], 6 },
  { "a pattern with optional letters", [[("a"):rep(60):find(("a?"):rep(60) .. ("a"):rep(60))]], 6 },
  { "%b", [[while true do ("("):rep(20000):find("%b()") end]], 6 },
  { "%f", [[while true do ("x"):rep(100000):find("%f[y]") end]], 6 },
  { "gmatch", [[for _ in ("a"):rep(300):gmatch(("a*"):rep(9) .. "b") do end]], 6 },
  { "gsub", [[("a"):rep(300):gsub(("a*"):rep(9) .. "b", "")]], 6 },
  { "a set that is long",
    [[local s = "[" .. ("x"):rep(100000) .. "]" while true do ("y"):rep(1000):find(s) end]], 6 },
  { "captures that go back", [[("a"):rep(300):find("(a*)(a*)(a*)(a*)(a*)%1%2%3%4%5b")]], 6 },
  { "a plain search", [[local s = ("a"):rep(1000000) while true do s:find("b", 1, true) end]], 6 },
  { "plain searches that find soon", [[local s, at = ("123456789,"):rep(100000), 1
    for i = 1, 100000 do at = s:find(",", at, true) + 1 end]], 0, "--limit steps=3e6,time=20" },
  { "a table with quotes", [[local t = {}
    for i = 1, 4000 do t[i] = ('%d,"n %d, x"'):format(i, i) end
    assert(#require("celspan.csv").decode(table.concat(t, "\n")) == 3999)]], 0,
    "--limit steps=3e6,time=20" },
  { "a deep pattern", [[("x"):rep(1000):find(("(x"):rep(30) .. ("x?"):rep(300))]], 3 },
  { "upper", [[local s = ("a"):rep(10000000) while true do s:upper() end]], 6 },
  { "format", [[while true do ("%99.99f"):format(1e308) end]], 6 },
  { "a chain of __call",
    [[local f = function() end for i = 1, 3e5 do f = setmetatable({}, { __call = f }) end f()]],
    3 },
  { "a chain of __index",
    [[local t = {} for i = 1, 1e4 do t = setmetatable({}, { __index = t }) end return t.x]], 3,
    "--limit time=20" },
  { "next",
    [[local t = {} for i = 1, 2000 do t[i] = i end for k in next, t do end while true do ]]
    .. [[next(t) end]], 6 },
  { "load", [[while true do load(("x = 1 "):rep(100000)) end]], 6 },
  { "load from a function", [[load(function() return "x = 1 " end)]], 6 },
  { "deep brackets", [[assert(not load(("("):rep(1e5) .. "1" .. (")"):rep(1e5)))]], 0 },
  { "deep ifs", [[assert(not load(("if x then "):rep(1e5) .. ("end "):rep(1e5)))]], 0 },
  { "30,000 coroutines that close each other", [[
    local co for i = 1, 30000 do local before = co
      co = coroutine.wrap(function() local x <close> = setmetatable({}, { __close = function()
        if before then pcall(before) end end }) if before then before() end error("x") end) end
          pcall(co)]], 0, "--limit steps=1e9,time=20,memory=512M" },
  { "a scan-line procedure", [[celspan.pixels(celspan.rostrum{ celspan.cel{ celspan.scanline{ bounds
    = { 0, 0, 4, 4 },
    spans = function() while true do end end } } }, { size = { 4, 4 } }) while true do end]], 6 },
  { "a picture without end", [[celspan.pixels(celspan.rostrum{ celspan.cel{ celspan.circle{ centre =
    { 1, 1 }, radius = 1,
    texture = celspan.radial{ centre = { 0, 0 }, radius = 1, { 0, "#fff" }, { 1, "#000" } } } } }, {
      size = { 30000, 30000 } })]], 6 },

  { "a file that nobody writes to",
    [[assert(select(2, require("celspan.sheet").read "pipe.lua"):find "is not a file")]], 0 },

  -- memory
  { "a text that doubles, caught",
    [[pcall(function() local s = "x" while true do s = s .. s end end)]], 6 },
  { "a text that doubles, caught by xpcall",
    [[xpcall(function() local s = "x" while true do s = s .. s end end, print)]], 6 },
  { "a text that doubles in a coroutine", [[coroutine.resume(coroutine.create(function()
    local s = "x" while true do s = s .. s end end))]], 6 },
  { "a text that doubles by rep, caught",
    [[pcall(function() local s = "x" while true do s = s:rep(2) end end)]], 6 },
  { "a text that doubles", [[local s = "x" while true do s = s .. s end]], 6 },
  { "a table that grows", [[local t = {} while true do t[#t + 1] = {} end]], 6 },
  { "a table of texts", [[local t = {} for i = 1, 1e9 do t[i] = ("x"):rep(1000) .. i end]], 6 },
  { "memory in pcall",
    [[local t = {} while true do pcall(function() t[#t + 1] = ("x"):rep(1000000) end) end]], 6 },
  { "memory in a coroutine", [[local t = {} while true do
    coroutine.resume(coroutine.create(function() while true do t[#t + 1] = ("x"):rep(1000000) end
      end)) end]], 6 },
  { "concat",
    [[local t = {} for i = 1, 1000 do t[i] = ("x"):rep(100000) end return table.concat(t)]], 6 },
  { "pack", [[return ("c1000000000"):pack("")]], 6 },
  { "gsub that grows", [[local s = ("x"):rep(10000) while true do s = s:gsub("x", "%0%0") end]],
    6 },
  { "a weak table and no memory", [[local mt, mm = {}, {} setmetatable(mt, mm) mm.__mode = "v"
    local t = setmetatable({}, mt) mt.__newindex = function(t, k, v) rawset(t, k, v) end
    for i = 1, 1e9 do t[i] = ("x"):rep(1000) .. i end]], 6 },
  { "cels without end", [[local t = {} for i = 1, 1e9 do
    t[i] = celspan.polygon{ { 0, 0 }, { i, 0 }, { i, i }, { 0, i } } end]], 6 },
  { "a long path", [[return celspan.path{ d = "M0 0" .. ("L1 1"):rep(5000000) }]], 6 },

  -- output
  { "print", [[while true do print(("x"):rep(1000)) end]], 6 },
}
