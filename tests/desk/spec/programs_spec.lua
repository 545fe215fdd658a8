-- What programs that write films read: --json of each verb, a script on standard input, the help as
-- data, llms.txt and docs/assistants.md.
local json = require "celspan.json"
local markdown = require "tests.support.markdown"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local it_sets_type = present.type() and it or pending

local FILM = [[
local celspan = require "celspan"
local set = celspan.parameters { x = { 4, min = 0, max = 8 }, list = 3 }
return celspan.film { title = "one", size = { 16, 9 }, fps = 12, frames = 6, marks = { late = 4 },
  frame = function(f)
    return celspan.rostrum { back = "#fff", celspan.cel {
      celspan.rect { 0, 1, 4, 4 }:translate(set.x + f.index // 2, 0):named "box" } }
  end }
]]

local bench

--- The output of a command as data.
local function decoded(...)
  local code, out, err = bench:celspan_inside(...)
  assert.are.equal(0, code, err)
  return assert(json.decode(out)), out
end

--- The entry of a list that has this name.
local function named(list, name)
  for _, one in ipairs(list) do
    if one.name == name then return one end
  end
  error("there is no " .. name)
end

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", FILM)
end)
after_each(function() bench:remove() end)

describe("--json", function()
  it("prints what info prints of a film", function()
    local facts = decoded "info film.lua --json"
    assert.same({ "one", 6, 1, 6, 12, 0.5, { 16, 9 }, 1, 3 }, { facts.title, facts.frames,
      facts.first, facts.last, facts.fps, facts.seconds, facts.size, facts.cels, facts.different })
    assert.same({ { name = "late", frame = 4 } }, facts.marks)
    assert.same({ { kind = "object", name = "box", frames = 6, file = "film.lua", line = 6 } },
      facts.named)
    assert.are.equal(8, facts.parameters.x.maximum)
    assert.are.equal(3, facts.parameters.list.default)
  end)

  it("prints what info prints of files", function()
    bench:celspan_inside "render film.lua -o a.span --frames 1 --progress none"
    bench:celspan_inside "render film.lua -o a.plane --progress none"
    local spans, plane = decoded "info a.span --json", decoded "info a.plane --json"
    assert.same({ "span", { 16, 9 } }, { spans.format, spans.size })
    assert.same({ "plane", 6, 12 }, { plane.format, plane.frames, plane.fps })
  end)

  it("prints a point, statistics and a sheet", function()
    local point = decoded "probe film.lua 0.5 0.5 --frame 2 --json"
    assert.same({ 2, 0.5, 1, 1, 1, 1 }, { point.frame, point.x, point.r, point.g, point.b,
      point.a })
    local counts, text = decoded "spans film.lua --stats --json"
    assert.are.equal(9, counts.rows)
    local _, line = bench:celspan_inside "spans film.lua --stats"
    for name in line:gmatch "([%l_]+) %d" do
      assert.are.equal("number", type(counts[name]), text)
    end
    local sheet = decoded "sheet film.lua --json"
    assert.same({ 12, 6, { 16, 9 }, "box" }, { sheet.fps, sheet.frames, sheet.size,
      sheet.layers[2].name })
    assert.same({ { frame = 1, drawing = "1" } }, sheet.layers[2].changes)
    assert.same({ { frame = 3, marks = { "moved" } }, { frame = 5, marks = { "moved" } } },
      sheet.layers[2].marks)
  end)

  it("prints how two pictures, or two films, differ", function()
    bench:celspan_inside "render film.lua -o a.##.tga --progress none"
    bench:celspan_inside "render film.lua -o b.##.tga --progress none --frames 1-5 --set x=5"
    local code, out = bench:celspan_inside "compare a.01.tga b.01.tga --json"
    local one = assert(json.decode(out))
    assert.same({ 1, 1, 8, 144 }, { code, one.largest, one.differing, one.pixels })
    code, out = bench:celspan_inside "compare 'a.##.tga' 'b.##.tga' --json"
    local frames = assert(json.decode(out)).frames
    assert.same({ 1, 6, 3, 8, "a.##.tga" }, { code, #frames, frames[3].frame,
      frames[3].differing, frames[6].only_in })
  end)

  it("prints nothing where the verb fails, and refuses what it cannot print", function()
    assert.same({ 4, "" }, { (bench:celspan_inside "info none.png --json"),
      (select(2, bench:celspan_inside "info none.png --json")) })
    assert.are.equal(2, (bench:celspan_inside "spans film.lua --json"))
    assert.are.equal(2, (bench:celspan_inside "sheet film.lua --json -o a.csv"))
  end)
end)

describe("the script -", function()
  --- Runs celspan with the film, or another text, as standard input.
  local function piped(arguments, text)
    bench:write("script.txt", text or FILM)
    return bench:inside(("'%s' %s < script.txt"):format(workbench.absolute, arguments))
  end

  it("is standard input, for each verb that runs it alone", function()
    for _, arguments in ipairs { "info -", "check - --json", "describe -", "probe - 1 1",
      "spans - --stats --json", "spans - --rows 2-3", "sheet - --json", "render - --hash",
      "render - --hash --set x=2", "tiles - -o made", "render - --hash -- a b" } do
      local code, out, err = piped(arguments)
      assert.are.equal(0, code, arguments .. err)
      local _, same = bench:celspan_inside(arguments:gsub(" %-", " film.lua", 1))
      local function plain(text)
        -- how many workers begin in time decides the counts after those of the spans
        return (text:gsub("film%.lua", "-"):gsub("\"?swept.*", ""))
      end
      assert.are.equal(plain(same), plain(out), arguments)
    end
  end)

  it("has the files of the current folder beside it, and lines in messages", function()
    bench:write("shapes.lua", "return { 1, 2, 3, 4 }")
    local code, out, err = piped("probe - 2 3", [[
local celspan = require "celspan"
return celspan.rostrum { size = { 9, 9 }, celspan.cel { celspan.rect(require "shapes") } }]])
    assert.same({ 0, "0 0 0 1\n" }, { code, out }, err)
    code, out = piped("check - --json", "local celspan = require 'celspan'\nlocal x = = 3")
    local fault = assert(json.decode(out))[1]
    assert.same({ 3, "-", 2 }, { code, fault.file, fault.line }, out)
    code, out = piped("check - --json", FILM:gsub("return", [[
local dot = celspan.circle { centre = { 1, 1 }, radius = 1 }
dot:translate(1, 1)
return]], 1))
    assert.same({ 0, "-", 4 }, { code, json.decode(out)[1].file, json.decode(out)[1].line }, out)
  end)

  it("is read as a file is: with a byte-order mark, and a first line for the shell", function()
    local code, out, err = piped("check - --json", "\u{FEFF}#!/usr/bin/env celspan\nreturn nil")
    assert.same({ 3, "- must return a film or a rostrum, got nil" },
      { code, (assert(json.decode(out))[1].message:gsub("^%-:%d+: ", "")) }, err)
    code, out = piped("check - --json", "#!/usr/bin/env celspan\nlocal x = = 3")
    assert.same({ 3, 2 }, { code, assert(json.decode(out))[1].line }, out)
    assert.are.equal(3, (piped("check -", "#")))
  end)

  it("is refused with a sentence where it is no script", function()
    for text, answer in pairs { ["\x89PNG\r\n\x1a\n"] = "-:1: unexpected symbol",
      ["return 1\0"] = "-:1: ", ["\27Lua"] = "-: attempt to load a binary chunk",
      ["error '\xff\xfe'"] = "-:1: " } do
      local code, out, err = piped("check - --json", text)
      assert.are.equal(3, code, err)
      local message = assert(json.decode(out))[1].message
      assert.are.equal(answer, message:sub(1, #answer))
      assert.truthy(utf8.len(message), message)
    end
    local code, _, err = bench:inside(("'%s' check - < ."):format(workbench.absolute))
    assert.same({ 4, "celspan: error: standard input: Is a directory\n" }, { code, err })
  end)

  it("is refused where it would be run again, or is empty", function()
    for _, arguments in ipairs { "farm - -o out/##.png --slurm", "watch -",
      "watch film.lua -", "play -",
      "render - -o {x}.png --table film.lua" } do
      local code, _, err = piped(arguments)
      assert.are.equal(2, code, arguments)
      assert.truthy(err:find("give the name of a file", 1, true), err)
    end
    local code, _, err = piped("check -", "")
    assert.are.equal(3, code, err)
    assert.truthy(err:find("- must return a film", 1, true), err)
  end)
end)

describe("help --json", function()
  it("has every verb and option, and every name and field of Lua", function()
    local all = decoded "help --json"
    for verb in system.output("'" .. workbench.binary .. "' help"):gmatch "\n  (%l+) +%u" do
      if verb ~= "help" then
        local one = named(all.verbs, verb)
        local help = system.output("'" .. workbench.binary .. "' help " .. verb)
        for option in help:gmatch "\n  (%-[%w-]+)" do
          assert.truthy(named(one.options, option), verb .. option)
        end
      end
    end
    local radius = named(named(all.lua.nouns, "circle").fields, "radius")
    assert.same({ false, 0, "number" }, { radius.required, radius.least, radius.type })
    assert.is_true(named(named(all.lua.nouns, "film").fields, "frame").required)
    assert.are.equal(24, named(named(all.lua.nouns, "film").fields, "fps").default)
    assert.are.equal("seconds",
      named(named(all.lua.functions, "celspan.motion.lag").parameters, "seconds").name)
    local celspan = require "celspan"
    for name, value in pairs(celspan) do
      if type(value) == "function" then
        local is_noun = pcall(named, all.lua.nouns, name)
        assert.truthy(is_noun or named(all.lua.functions, "celspan." .. name), name)
      end
    end
    assert.truthy(named(all.exit_codes, "33") and named(all.environment, "CELSPAN_MEMORY"))
  end)
end)

describe("the pages for programs", function()
  local PAGE = "docs/assistants.md"
  local text = markdown.read(PAGE)

  -- The folder of a new film has everything that the pages need.
  before_each(function() assert.are.equal(0, (bench:celspan_inside "init harbour")) end)

  it("are short, and printed by the program", function()
    local _, lines = text:gsub("\n", "")
    assert.is_true(lines <= 120, lines .. " lines")
    local _, rules = text:gsub("\n%d+%. %*%*", "")
    assert.are.equal(10, rules)
    assert.are.equal(text, select(2, bench:celspan_inside "help assistants"))
  end)

  it_sets_type("have films without a fault or a warning", function()
    for _, page in ipairs { PAGE, "llms.txt" } do
      local count = 0
      for _, block in ipairs(markdown.blocks(page)) do
        if block.language == "lua" then
          count = count + 1
          bench:write("harbour/film.lua", block.text)
          assert.same({}, (decoded "check harbour/film.lua --json"), page .. ":" .. block.line)
        end
      end
      assert.are.equal(1, count, page)
    end
  end)

  it_sets_type("have mistakes with what check says of them", function()
    local count = 0
    for written, answered in text:gmatch "\n| `([^\n]-)` | `([^\n]-)` |" do
      count = count + 1
      bench:write("harbour/film.lua", ([[
local celspan = require "celspan"
local dot = celspan.circle { centre = { 9, 9 }, radius = 5 }
local n = 0
return celspan.film { size = { 320, 180 }, fps = 24, frames = 20, frame = function(f)
  local art
  do %s end
  return celspan.rostrum { back = { 0.1, 0.1, 0.1 },
    celspan.cel { dot:translate(f.index, 0), art } }
end }]]):format(written))
      local _, out = bench:celspan_inside "check harbour/film.lua --json"
      local said = {}
      for i, one in ipairs(assert(json.decode(out))) do said[i] = one.message end
      assert.truthy(table.concat(said, "\n"):find(answered, 1, true), written .. "\n" .. out)
    end
    assert.are.equal(10, count)
  end)

  it("name verbs and pages that exist", function()
    local help = system.output("'" .. workbench.binary .. "' help")
    local index = markdown.read "llms.txt"
    for verb in (text .. index):gmatch "celspan (%l+) [%l-]+[.%s]" do
      assert.truthy(help:find("\n  " .. verb .. " ", 1, true), verb)
    end
    for target in index:gmatch "%]%(([^)#]+)%)" do
      assert.is_true(system.exists(target), target)
    end
    for name in index:gmatch "`celspan%.(%l+)[`%s]" do
      assert.are.equal(0, (bench:celspan_inside("help lua " .. name)), name)
    end
  end)
end)
