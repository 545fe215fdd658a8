--- The functions that the sandbox replaces, called with random arguments: prints every result. With
--- and without --trust the results are the same.
local celspan = require "celspan"

local state = tonumber((...)) or 1
local function random(n)
  state = (state * 48271) % 2147483647
  return state % n + 1
end

local function pick(list) return list[random(#list)] end

local function answer(name, ...)
  local results = table.pack(pcall(...))
  for i = 1, results.n do
    results[i] = tostring(results[i]):gsub("^[^ ]*:%d+: ", ""):gsub("to '[^']+'", "to ?")
      :gsub(": 0x%x+", "")
  end
  print(name, table.concat(results, "|"))
end

-- ---------------------------------------------------------------- patterns

local PIECES = { "a", "b", ".", "%a", "%d", "%s", "%A", "%w", "%x", "%.", "%%", "[ab]", "[^a]",
  "[a-c]", "[%d.]", "[]]", "[^]]",
  "[a-]", "%b()", "%f[%a]", "%f[^%a]", "()", "(a)", "(.)", "(%a+)", "(a*)", "%1", "%2", "$", "^",
  "(", ")", "[", "%",
  "\0", "[%z\1-\31]", "é", "-", "*" }
local OFTEN = { "", "", "", "*", "+", "-", "?" }
local LETTERS = { "a", "b", "c", "(", ")", ".", "1", " ", "%", "]", "\0", "é", "a", "b" }

local function text_of(list, most)
  local parts = {}
  for i = 1, random(most) - 1 do parts[i] = pick(list) end
  return table.concat(parts)
end

local function pattern()
  local parts = {}
  for i = 1, random(5) do parts[i] = pick(PIECES) .. pick(OFTEN) end
  return (random(4) == 1 and "^" or "") .. table.concat(parts) .. (random(5) == 1 and "$" or "")
end

local REPLACEMENTS = { "x", "%0%0", "%1", "[%1%2]", "%%", "%", "%9", "",
  { a = "A", b = false, ["1"] = 2 },
  function(a, b) return a == "a" and (b or "z") end, function() return nil end,
  function() return {} end, 7 }

for _ = 1, 4000 do
  local subject, wanted, init = text_of(LETTERS, 12), pattern(),
    pick { 1, 1, 1, 2, 0, -1, -3, 20, 5 }
  answer("find", string.find, subject, wanted, init)
  answer("plain", string.find, subject, wanted, init, true)
  answer("match", string.match, subject, wanted, init)
  answer("gsub", string.gsub, subject, wanted, pick(REPLACEMENTS), pick { nil, 0, 1, 2, -1, 100 })
  answer("gmatch", function()
    local all = {}
    for a, b in subject:gmatch(wanted, init) do
      all[#all + 1] = tostring(a) .. "," .. tostring(b)
      if #all > 50 then break end
    end
    return table.concat(all, ";")
  end)
end

-- ---------------------------------------------------------------- texts and tables

local FORMATS = { "%d", "%5d", "%-5d|", "%s", "%10s", "%.2s", "%q", "%x", "%g", "%5.2f", "%i", "%c",
  "%%", "%u", "%", "%5", "%a" }
local VALUES = { 1, 2.5, "a", "10", "", true, -3, 65, nil, "a\nb\0c", 1e100, math.huge, 3.0 }
for _ = 1, 1500 do
  answer("format", string.format, pick(FORMATS) .. pick(FORMATS), pick(VALUES), pick(VALUES))
  answer("rep", string.rep, pick { "", "a", "ab" }, pick { 0, 1, -1, 3, 7 }, pick { nil, "", "," })
  answer("case", function(s)
    return s:upper(), s:lower(), s:reverse(), s:len(), s:byte(1, -1)
  end, text_of(LETTERS, 9))
  local list = {}
  for k = 1, random(8) - 1 do list[k] = pick { 3, 1, 2, 5.5, 2 } end
  answer("insert", function()
    table.insert(list, pick { 1, 2, 0, 9, #list + 1 }, "x")
    return table.concat(list, ",")
  end)
  answer("remove", function()
    return table.remove(list, pick { nil, 1, 2, 20, 0 }), table.concat(list, ",")
  end)
  answer("concat", table.concat, list, pick { ",", "", nil }, pick { 1, 2, nil },
    pick { nil, 1, 3 })
  answer("unpack", table.unpack, list, pick { 1, 2, nil }, pick { nil, 1, 5 })
  answer("move", function()
    -- It can leave holes, and lists with holes end elsewhere in the sandbox.
    return table.unpack(table.move(list, pick { 1, 2 }, pick { 0, 2, 3 }, pick { 1, 2, 4 }), 1, 8)
  end)
  local numbers = {}
  for k = 1, random(40) do numbers[k] = random(1000) end
  answer("sort", function() table.sort(numbers) return table.concat(numbers, ",") end)
  answer("descend", function()
    table.sort(numbers, function(a, b) return a > b end)
    return table.concat(numbers, ",")
  end)
end

-- ---------------------------------------------------------------- the rest

-- Arguments that random choice rarely or never gives.
for _, one in ipairs {
  { "find", "abc", "" }, { "find", "abc", "", 3, true }, { "find", "abc", "", 9 },
  { "match", "abc", "" },
  { "match", "f(a(b)c)", "%b()" }, { "match", "f(a(b)c", "%b()" }, { "match", "'a'b'", "%b''" },
  { "match", "a", "%b(" },
  { "match", "THE (quick) fox", "%f[%a]%a+%f[%A]" }, { "match", "a", "%f" },
  { "match", "a", "%fa" }, { "match", "a", "%0" },
  { "match", "a", ("()"):rep(33) }, { "match", "a", ("()"):rep(32) },
  { "match", "a1_\t B", "%l%d%p%c%s%u" },
  { "match", "a1_\t B", "%g+" }, { "match", "aB", "%L%U" }, { "match", "Ab", "%L%U" },
  { "gsub", "abc", "", "-" },
  { "gsub", "abc", "^a", "%%" }, { "gsub", "abc", "b", "%a" }, { "gsub", "abc", "b", "%!" },
  { "gsub", "abc", "b" },
  { "gsub", "abc", "b", true }, { "gsub", ("a"):rep(3000), "a", "%%" },
  { "rep", "ab", math.maxinteger },
  { "format", "%s %s", 1 }, { "format", "%10q", "a" },
  { "format", "%s", setmetatable({}, { __name = "N" }) },
} do answer(one[1], string[one[1]], table.unpack(one, 2)) end
answer("insert", function() local t = { 1 } table.insert(t, 2) return #t, t[2] end)
answer("unpack", function()
  local a, b, c = table.unpack(celspan.cel { celspan.rect { 0, 0, 1, 2 },
    celspan.rect { 0, 0, 3, 4 } })
  return a[4], b[4], c
end)

local function fails() error({}) end
answer("pcall", pcall, error, "x")
answer("pcall", pcall)
answer("xpcall", xpcall, error, function(m) return "<" .. m .. ">" end, "x")
answer("xpcall", xpcall, function(...) return ... end, print, 1, nil, 3)
answer("xpcall", xpcall, fails, type)
answer("xpcall", xpcall, print)
answer("error", fails)
answer("assert", assert, false, "no")
answer("select", select, "#", 1, nil)
answer("load", load, "return 1 +")
answer("load", function() return load("return ...", "x")(5) end)
answer("load", function() return load("return x", "x", "t", { x = 7 })() end)
answer("load", function()
  local n = 0
  return load(function() n = n + 1 return ({ "return", " 8" })[n] end)()
end)
answer("load", load, function() return {} end)
answer("load", load, function() error "no more" end)
answer("load", load, function() error({}) end)
answer("load", load)
answer("tostring", tostring, setmetatable({}, { __tostring = function() return {} end }))
answer("tostring", tostring, setmetatable({}, { __name = "N" }))
answer("tostring", tostring, setmetatable({}, { __name = 5 }))
answer("tostring", tostring)
answer("setmetatable", setmetatable, {})
answer("setmetatable", setmetatable, {}, 5)
answer("setmetatable", function()
  local t = setmetatable({}, { __index = { a = 1 } })
  local before = t.a
  setmetatable(t, { __index = { a = 2 } })
  local between = t.a
  return before, between, getmetatable(setmetatable(t, nil)), t.a
end)
answer("getmetatable", function() return getmetatable(5), getmetatable({}), getmetatable(print) end)
answer("setmetatable", function()
  local class = {}
  class.__index = class
  function class.name() return "class" end
  local one = setmetatable({}, class)
  class.__add = function() return "added" end
  class.__close = function() end
  local other <close> = setmetatable({}, class)
  return one.name(), getmetatable(one) == class, other + 1, rawequal(getmetatable(other), class)
end)
answer("metamethods", function()
  local m = { __call = function(_, a)
    return a
  end, __len = function() return 5 end, __eq = function() return true end,
    __lt = function() return true end, __le = function() return false end,
    __concat = function() return "c" end,
    __unm = function() return "u" end, __tostring = function() return "t" end, __name = "N",
    __newindex = function(t, k, v) rawset(t, k, v + 1) end, __idiv = function() return "i" end }
  local a, b = setmetatable({}, m), setmetatable({}, m)
  a.x = 1
  return a(3), #a, a == b, a < b, a <= b, a .. b, -a, tostring(a), a.x, a // b
end)
answer("__pairs", function()
  local all = {}
  for k, v in pairs(setmetatable({}, { __pairs = function() return next, { 5 }, nil end })) do
    all[#all + 1] = k .. v
  end
  return table.concat(all)
end)
answer("inherit", function()
  local base = { hello = function() return "hello" end }
  base.__index = base
  local derived = setmetatable({ __index = function(_, k) return base[k] end }, base)
  return setmetatable({}, derived).hello()
end)
answer("coroutine", function()
  local co = coroutine.create(function(a, b)
    local c = coroutine.yield(a + b)
    local d, e = coroutine.yield(c * 2)
    return d .. e
  end)
  local all = { coroutine.resume(co, 1, 2) }
  all[#all + 1] = select(2, coroutine.resume(co, 10))
  all[#all + 1] = select(2, coroutine.resume(co, "x", "y"))
  all[#all + 1] = coroutine.status(co)
  local good, why = coroutine.resume(co)
  all[#all + 1] = tostring(good) .. why
  for i, v in ipairs(all) do all[i] = tostring(v) end
  return table.concat(all, " ")
end)
answer("coroutine", function()
  local co = coroutine.wrap(function()
    pcall(coroutine.yield, 1)
    coroutine.yield(2)
    error "three"
  end)
  return co(), co(), pcall(co)
end)
answer("coroutine", function()
  local co = coroutine.wrap(function() return table.unpack { 1, 2, 3 } end)
  return co()
end)
answer("coroutine", coroutine.wrap, 1)
answer("coroutine", coroutine.wrap(fails))
answer("coroutine", coroutine.resume, 5)
answer("coroutine", coroutine.resume, coroutine.create(fails))
-- A stack holds a million values.
local function with_half_a_stack(work) return work(table.unpack({}, 1, 600000)) end
answer("coroutine", function()
  local co = coroutine.create(function()
    with_half_a_stack(function(...) coroutine.yield() return (...) end)
  end)
  coroutine.resume(co)
  return coroutine.resume(co, table.unpack({}, 1, 600000))
end)
answer("coroutine", function()
  local co = coroutine.create(function() return table.unpack({}, 1, 600000) end)
  return with_half_a_stack(function(...)
    local good, why = coroutine.resume(co)
    return good, why, (...)
  end)
end)
answer("next", function() local t = { 7 } local k, v = next(t) return k, v, next(t, k), next {} end)
answer("pairs", function()
  local t, all = { 1, 2, 3 }, {}
  for k in pairs(t) do t[k] = nil all[#all + 1] = k end
  return table.concat(all, ","), next(t)
end)
answer("pairs", function()
  local t, all = { 1, 2, 3 }, {}
  for k in pairs(t) do t[k + 1] = nil all[#all + 1] = k end
  return table.concat(all, ",")
end)
answer("goto", function() for i = 1, 3 do if i == 2 then goto out end end ::out:: return "out" end)
for x = -8, 8, 0.37 do
  answer("math", function()
    return ("%.12g %.12g %.12g %.12g %.12g %.12g")
      :format(math.sin(x), math.cos(x), math.tan(x), math.exp(x),
      math.atan(x, 2), math.log(math.abs(x)))
  end)
  answer("arc", function()
    return ("%.10g %.10g %.10g"):format(math.asin(x / 9), math.acos(x / 9),
      math.log(math.abs(x), 10))
  end)
end
answer("log", function()
  return ("%.12g %.12g %.12g"):format(math.log(3, 2), math.log(8, 3), math.log(0.125, 2))
end)
answer("log", function()
  return math.log(math.huge, 2), math.log(-8, 2) ~= math.log(-8, 2), math.log(0, 2)
end)
answer("random", math.random, 3, 1)
answer("random", math.random, 1, 2, 3)
answer("random", math.random, "x")
answer("random", function() return math.random(7, 7) end)
answer("randomseed", math.randomseed, "x")
answer("whole", function()
  return math.log(8, 2), math.log(1024, 2), math.exp(0), math.sin(0), math.cos(0)
end)
for _, x in ipairs { math.huge, -math.huge, 0 / 0, 1e300, -1e300, 1e-300, 2e6, -745.5, 709.9, 0.0,
  -0.0 } do
  answer("far", function()
    local all = { math.sin(x), math.cos(x), math.tan(x), math.atan(x), math.atan(1, x),
      math.atan(x, x), math.exp(x),
      math.log(x), math.asin(x), math.acos(x) }
    for i, v in ipairs(all) do all[i] = v ~= v and "nan" or ("%.12g"):format(v) end
    return table.concat(all, " ")
  end)
end

return celspan.rostrum { celspan.cel {} }
