-- celspan farm --openjd: the template is compared with the specification, and run with its
-- parameters filled in.
local configuration = require "tests.support.configuration"
local farm = require "tests.support.farm"
local json = require "celspan.json"
local openjd = require "tests.support.openjd"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local done, frames_in, refused, same, shell, word =
  farm.done, farm.frames_in, farm.refused, farm.same, farm.shell, farm.word

local bench

before_each(function() bench = farm.begin() end)
after_each(farm.finish)

local function template(arguments)
  local text = done("farm film.lua --openjd " .. arguments)
  return assert(json.decode(text)), text
end

describe("the template of Open Job Description", function()
  it("makes every frame once", function()
    done "render film.lua -o whole/####.png --progress none"
    for chunk, tasks in pairs { [1] = 7, [3] = 3, [50] = 1 } do
      os.execute("rm -rf " .. bench.folder .. "/out")
      local job = template("-o out/####.png --chunk " .. chunk)
      openjd.check(job)
      assert.equal(tasks, #openjd.commands_of(job, job.steps[1]))
      openjd.run(job, bench)
      for i = 3, 9 do same(("out/%04d.png"):format(i), ("whole/%04d.png"):format(i)) end
    end
  end)

  it("makes strips of a frame, and then joins them", function()
    local job = template "-o 'a b/one.span' --frames 4 --size 70x1100 --strips 3"
    openjd.check(job)
    assert.same({ { dependsOn = "Render" } }, job.steps[2].dependencies)
    openjd.run(job, bench)
    done "render film.lua -o whole.span --frames 4 --size 70x1100"
    same("a b/one.span", "whole.span")
  end)

  it("passes options and arguments on, unusual ones as parameters", function()
    local odd = [[it's "a" $HOME {{x}} \ é]] .. "\nend"
    assert.equal(true, os.execute("mkdir " .. word(bench.folder .. "/" .. odd)))
    local job, text = template(("-o %s --frames 5,3 --size 30x20 --allow %s --limit time=9 "
      .. "--background=#102030 --job-memory 900 --job-time 2 --workers 2 --job-name %s -- 7.5 %s")
      :format(word(odd .. "/{{y}}.#.png"), word(odd), word "a{{b}}\nc", word(odd)))
    openjd.check(job)
    assert.is_truthy(text:find('"Text1"', 1, true))
    assert.equal("a--b--?c", job.name)
    assert.equal(120, job.steps[1].script.actions.onRun.timeout)
    assert.same({ { name = "amount.worker.vcpu", min = 2 },
                  { name = "amount.worker.memory", min = 900 } },
      job.steps[1].hostRequirements.amounts)
    openjd.run(job, bench)
    done("render film.lua -o whole/#.png --frames 5,3 --size 30x20 --background '#102030' -- 7.5")
    same(odd .. "/{{y}}.5.png", "whole/5.png")
  end)

  it("has paths without dots in them, by whose beginnings farms map them", function()
    assert.equal(0, (bench:inside "mkdir -p far/deep && ln -s far/deep link"))
    local function values(command)
      local code, out, err = shell(command)
      assert.equal(0, code, err)
      local by_name = {}
      for _, one in ipairs(assert(json.decode(out)).parameterDefinitions) do
        by_name[one.name] = one.default
      end
      return by_name
    end
    local plain = values '"$CELSPAN" farm film.lua --openjd -o o/#.png'
    local dotted = values(
      'cd far && "$CELSPAN" farm .././film.lua --openjd -o ../far/../o/#.png')
    for _, name in ipairs { "Script", "Folder", "Output" } do
      assert.equal(plain[name], dotted[name])
    end
    -- The link makes this the folder far/o.
    assert.equal(bench.folder .. "/link/../o",
      values('"$CELSPAN" farm film.lua --openjd -o link/../o/#.png').Output)
  end)

  it("refuses values that a template cannot contain", function()
    refused("has more than 1024 characters",
      "farm film.lua --openjd -o o/#.png -- " .. word("\n" .. ("x"):rep(1024)))
    refused("the template is UTF-8", "farm film.lua --openjd -o o/#.png -- '\xff'")
    local many = {}
    for i = 1, 48 do many[i] = word("{{" .. i) end
    refused("at most 50", "farm film.lua --openjd -o o/#.png -- " .. table.concat(many, " "))
  end)

  it("names frames by ranges, and in chunks only where a task has several", function()
    local job = template "-o o/#.png --frames 9,3,4,5,7 --chunk 2"
    openjd.check(job)
    local step = job.steps[1]
    local task = step.parameterSpace.taskParameterDefinitions[1]
    assert.same({ "3,4", "5,7", "9" }, openjd.tasks_of(task,
      { ["Param.Frames"] = "3-5,7-9:2", ["Param.Chunk"] = "2" }))
    local by_name = {}
    for _, one in ipairs(job.parameterDefinitions) do by_name[one.name] = one.default end
    assert.equal("3-5,7,9", by_name.Frames)
    assert.equal(2, by_name.Chunk)
    openjd.run(job, bench)
    assert.equal("3.png 4.png 5.png 7.png 9.png", frames_in "o")
    job = template "-o p/#.png --chunk 1 --frames 3-9:3"
    openjd.check(job)
    assert.is_nil(job.extensions)
    local frames = job.parameterDefinitions[5]
    assert.same({ "Frames", "3-9:3" }, { frames.name, frames.default })
    openjd.run(job, bench, { Frames = "4-6:2,8" }) -- as somebody has changed it
    assert.equal("4.png 6.png 8.png", frames_in "p")
  end)

  it("offers what the script declares, and gives it to the tasks", function()
    bench:write("set.lua", [[
      local celspan = require "celspan"
      local p = celspan.parameters {
        radius = { 10, min = 1, max = 30, about = "Of the\ndisc", group = "Disc" },
        loud = false, mood = { "calm", "wild" }, at = { 9, 20, point = true },
        title = "", big = 1e9, [("x"):rep(64)] = 1 }
      return celspan.film { size = { 60, 40 }, frames = 2, frame = function()
        return celspan.rostrum { celspan.cel { celspan.circle { centre = p.at, radius = p.radius,
          texture = p.mood == "wild" and "#f00" or p.loud and "#0f0" or "#00f" } } }
      end }]])
    local arguments = "farm set.lua --openjd -o o/#.png --chunk 1 "
    local settings = "--set radius=5 --set loud=yes --set at=30,2"
    local job = assert(json.decode(done(arguments .. settings)))
    openjd.check(job)
    local by_name = {}
    for _, one in ipairs(job.parameterDefinitions) do by_name[one.name] = one end
    assert.equal(5, by_name.Set_radius.default)
    assert.equal("FLOAT", by_name.Set_radius.type)
    assert.equal(30, by_name.Set_radius.maxValue)
    assert.equal("Of the?disc", by_name.Set_radius.description)
    assert.equal("Disc", by_name.Set_radius.userInterface.groupLabel)
    assert.equal("30,2", by_name.Set_at.default)
    assert.same({ "calm", "wild" }, by_name.Set_mood.allowedValues)
    openjd.run(job, bench, { Set_radius = "7.5", Set_mood = "wild" })
    done "render set.lua -o w/#.png --set radius=7.5 --set mood=wild --set at=30,2"
    for i = 1, 2 do same(("o/%d.png"):format(i), ("w/%d.png"):format(i)) end
    bench:write("values.json", '{ "radius": 6 }')
    job = assert(json.decode(done(arguments .. "--set-from values.json --set mood=wild")))
    openjd.check(job)
    openjd.run(job, bench)
    done "render set.lua -o w/#.png --set radius=6 --set mood=wild"
    same("o/2.png", "w/2.png")
  end)

  it("names the script's folder, and files elsewhere", function()
    assert.equal(true, os.execute(("mkdir -p %s/scene %s/far"):format(word(bench.folder),
      word(bench.folder))))
    bench:write("far/part.lua", "return 7")
    bench:write("scene/near.lua", "return 8")
    bench:write("scene/film.lua", 'require "near" require "part"\n' .. farm.FILM)
    local function paths(options)
      local text = done("farm scene/film.lua --openjd -o out/#.png " .. options)
      local job, list = assert(json.decode(text)), {}
      openjd.check(job)
      for _, one in ipairs(job.parameterDefinitions) do
        if one.dataFlow == "IN" then
          list[#list + 1] = one.name .. " " .. one.default:sub(#bench.folder + 2)
        end
      end
      return table.concat(list, ", ")
    end
    local code, out, err = shell("CELSPAN_PATH=" .. word(bench.folder .. "/far/?.lua")
      .. ' "$CELSPAN" farm scene/film.lua --openjd -o out/#.png')
    assert.equal(0, code, err)
    assert.is_truthy(out:find("far/part.lua", 1, true), out)
    bench:write("scene/film.lua", 'require "near"\n' .. farm.FILM)
    assert.equal("Script scene/film.lua, Folder scene", paths "")
    assert.equal("Script scene/film.lua, Folder scene, Allow1 far", paths "--allow far")
  end)

  --- The defaults of the parameters of a job, by their names.
  local function defaults_of(job)
    local values = {}
    for _, one in ipairs(job.parameterDefinitions) do values[one.name] = one.default end
    return values
  end

  --- The template for other scripts than film.lua, in the form of the specification.
  local function checked(arguments)
    local job = assert(json.decode(done("farm --openjd " .. arguments)))
    openjd.check(job)
    return job, defaults_of(job)
  end

  it("has a log of each task", function()
    assert.equal(true, os.execute("mkdir " .. word(bench.folder) .. "/logs"))
    local job, values = checked "film.lua -o o/#.png --chunk 3 --log logs/run.log"
    assert.equal(bench.folder .. "/logs", values.Log)
    openjd.run(job, bench)
    assert.same({ "run.3,4,5.log", "run.6,7,8.log", "run.9.log" }, bench:files "logs")
    checked "film.lua -o o.png --frames 3 --strips 1 --log run.log"
    refused("become too long", ("farm film.lua --openjd -o o/#.png --log %s.log")
      :format(("n"):rep(250)))
  end)

  it("finds files for strips and tables, and those of videos", function()
    local outside = workbench.new()
    outside:write("a.csv", "1")
    outside:write("talk.srt", "1\n00:00:00,000 --> 00:00:01,000\nhello\n")
    outside:write("hum.wav", "RIFF")
    bench:write("far.lua", ([[
      local celspan = require "celspan"
      celspan.parameters { radius = 10 }
      return celspan.film { size = { 60, 1200 }, frames = 2, captions = "%s/talk.srt",
        sound = "%s/hum.wav", frame = function()
          require "celspan.csv".read "%s/a.csv"
          return celspan.rostrum { back = "#fff" }
        end }]]):gsub("%%s", outside.folder))
    bench:write("rows.csv", "radius,name\n2,a\n")
    local allowed = " --trust"
    local _, values = checked("far.lua -o o.png --frames 1 --strips 2" .. allowed)
    assert.same({ outside.folder .. "/a.csv" }, { values.File1, values.File2 })
    _, values = checked("far.lua -o '{name}/#.png' --table rows.csv" .. allowed)
    assert.same({ outside.folder .. "/a.csv" }, { values.File1, values.File2 })
    _, values = checked("far.lua -o '{name}.mp4' --table rows.csv" .. allowed)
    assert.same({ outside.folder .. "/a.csv", outside.folder .. "/hum.wav",
                  outside.folder .. "/talk.srt" }, { values.File1, values.File2, values.File3 })
    outside:remove()
  end)

  local it_draws = present.type() and it or pending
  it_draws("finds files that drawings show", function()
    local outside = workbench.new()
    outside:write("inner.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="6" height="4"/>')
    outside:write("outer.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="6" height="4">'
      .. '<image href="inner.svg"/></svg>')
    bench:write("draw.lua", ([[
      local celspan, svg = require "celspan", require "celspan.svg"
      return celspan.film { size = { 60, 40 }, frames = 2, frame = function()
        return celspan.rostrum { celspan.cel { svg.load("%s/outer.svg").object } }
      end }]]):format(outside.folder))
    local _, values = checked "draw.lua -o o/#.png --trust"
    assert.same({ outside.folder .. "/inner.svg", outside.folder .. "/outer.svg" },
      { values.File1, values.File2, values.File3 })
    outside:remove()
  end)

  it("leaves room for files before it offers what the script declares", function()
    local outside = workbench.new()
    local script = { 'local celspan, csv = require "celspan", require "celspan.csv"',
                     "celspan.parameters {" }
    for i = 1, 40 do script[#script + 1] = ("p%d = %d,"):format(i, i) end
    script[#script + 1] = "}"
    for i = 1, 8 do
      script[#script + 1] = ("csv.read %q"):format(outside:write(i .. ".csv", "1"))
    end
    script[#script + 1] = farm.FILM:gsub("^local[^\n]*", "")
    bench:write("many.lua", table.concat(script, "\n"))
    local job, values = checked "many.lua -o o/#.png --set p7=70 --trust"
    assert.equal(outside.folder .. "/8.csv", values.File8)
    assert.equal(70, values.Set_p7)
    assert.is_nil(values.Set_p8)
    assert.is_true(#job.parameterDefinitions <= 50)
    outside:remove()
  end)

  it("keeps braces of either side out of its arguments", function()
    local job, values = checked "film.lua -o 'o/a}}b.#.png' --frames 3 -- 7.5"
    assert.equal("a}}b.#.png", values.Text1)
    openjd.run(job, bench)
    done "render film.lua -o w.png --frames 3 -- 7.5"
    same("o/a}}b.3.png", "w.png")
  end)

  it("refuses a folder whose name the rows of a table would replace", function()
    bench:write("rows.csv", "name\na\n")
    bench:shell("mkdir -p " .. word(bench.folder .. "/a{name}/{{b"))
    local arguments = '"$CELSPAN" farm --openjd --table %s/rows.csv ../%s -o %s'
    local code, _, err = shell("cd 'a{name}' && " .. arguments:format("..", "film.lua",
      "'{name}/#.png'"))
    assert.equal(2, code)
    assert.is_truthy(err:find("takes {name} in the name of the folder", 1, true), err)
    local out
    code, out, err = shell("cd 'a{name}/{{b' && " .. arguments:format("../..", "../film.lua",
      word(bench.folder .. "/{name}/#.png")))
    assert.equal(0, code, err)
    local job = assert(json.decode(out))
    openjd.check(job)
    openjd.run(job, bench)
    assert.equal("3.png 4.png 5.png 6.png 7.png 8.png 9.png", frames_in "a")
  end)

  it("names the folder of numbered pictures, and a painting's folder", function()
    done "render film.lua -o plates/p.####.png"
    local job, values = checked "'plates/p.####.png' -o o/#.png"
    assert.is_nil(values.Script)
    assert.equal(bench.folder .. "/plates", values.Folder)
    openjd.run(job, bench)
    done "render 'plates/p.####.png' -o w/#.png"
    assert.equal(frames_in "w", frames_in "o")
    same("o/9.png", "w/9.png")
  end)

  local it_converts = present.spaces() and it or pending
  it_converts("names the configuration of colours, and its folder", function()
    bench:shell("mkdir -p " .. bench.folder .. "/show/luts " .. bench.folder .. "/scene")
    bench:write("show/luts/half.cube", "LUT_3D_SIZE 2\n" .. ("0 0 0\n"):rep(7) .. "0.5 0.5 0.5\n")
    bench:write("show/config.ocio", configuration("search_path: luts",
      "    from_reference: !<FileTransform> {src: half.cube}"))
    bench:write("scene/film.lua", farm.FILM)
    local options = "scene/film.lua --colour half --frames 3 "
    local job, values = checked(options .. "-o o/#.png --ocio show/config.ocio")
    assert.equal(bench.folder .. "/show/config.ocio", values.Ocio)
    assert.equal(bench.folder .. "/show", values.OcioFolder)
    openjd.run(job, bench)
    done("render " .. options .. "-o w/#.png --ocio show/config.ocio")
    same("o/3.png", "w/3.png")
    local _, out = shell("OCIO=show/config.ocio \"$CELSPAN\" farm --openjd -o p/#.png " .. options)
    assert.equal(values.Ocio, defaults_of(assert(json.decode(out))).Ocio)
    _, values = checked("scene/film.lua -o o/#.png --ocio ocio://default")
    assert.is_nil(values.Ocio)
    bench:write("scene/config.ocio", bench:read "show/config.ocio")
    _, values = checked("scene/film.lua -o o/#.png --ocio scene/config.ocio")
    assert.equal(bench.folder .. "/scene/config.ocio", values.Ocio)
    assert.is_nil(values.OcioFolder)
  end)

  it("keeps texts of any kind within the rules", function()
    bench:write("odd.lua", [[
      local celspan = require "celspan"
      celspan.parameters { plain = { 1, about = "", group = "" },
        a = { 2, about = "one\u{85}two", group = "g\u{9f}" },
        long = { "x", ("y"):rep(2000) } }
      return celspan.film { size = { 60, 1200 }, frames = 1, frame = function()
        return celspan.rostrum { back = "#fff" }
      end }]])
    local job, values =
      checked "odd.lua -o 'o/{{a.png' --format png --strips 2 -- 'a\u{85}b' 'c\u{85}'"
    assert.equal("{{a.png", values.Text1)
    assert.equal("x", values.Set_long)
    openjd.run(job, bench)
    done "render odd.lua -o w.png --frames 1"
    assert.is_truthy(bench:read "o/{{a.png")
    job = checked("odd.lua -o 'o.{{x' --format png -- " .. ("a}} "):rep(60))
    assert.equal("odd", job.name)
    bench:write(".lua", farm.FILM)
    assert.equal(".lua", checked(".lua -o o/#.png").name)
    for _, one in ipairs(job.parameterDefinitions) do
      if one.name == "Set_a" then
        assert.equal("one?two", one.description)
        assert.equal("g?", one.userInterface.groupLabel)
      end
    end
  end)

  it("has these fields, all of which are in the specification", function()
    bench:write("set.lua", [[
      local celspan = require "celspan"
      celspan.parameters { size = { 10, min = 1, max = 30, about = "Of it", group = "Disc" },
        mood = { "calm", "wild" } }
      return celspan.film { size = { 60, 1200 }, frames = 2, frame = function()
        return celspan.rostrum { back = "#fff" }
      end }]])
    bench:write("rows.csv", "size\n1\n2\n")
    local fields = {}
    for _, arguments in ipairs { "set.lua -o o/#.png --job-time 1 --job-memory 9 --workers 2",
                                 "set.lua -o o/#.png --chunk 1",
                                 "set.lua -o o.png --frames 1 --strips 2",
                                 "set.lua -o 'o/{size}/#.png' --table rows.csv" } do
      for name in pairs(openjd.check(checked(arguments))) do fields[name] = true end
    end
    local list = {}
    for name in pairs(fields) do list[#list + 1] = name end
    table.sort(list)
    assert.equal([[
description
extensions
name
parameterDefinitions
parameterDefinitions.allowedValues
parameterDefinitions.dataFlow
parameterDefinitions.default
parameterDefinitions.description
parameterDefinitions.maxValue
parameterDefinitions.minValue
parameterDefinitions.name
parameterDefinitions.objectType
parameterDefinitions.type
parameterDefinitions.userInterface
parameterDefinitions.userInterface.groupLabel
specificationVersion
steps
steps.dependencies
steps.dependencies.dependsOn
steps.hostRequirements
steps.hostRequirements.amounts
steps.hostRequirements.amounts.min
steps.hostRequirements.amounts.name
steps.name
steps.parameterSpace
steps.parameterSpace.taskParameterDefinitions
steps.parameterSpace.taskParameterDefinitions.chunks
steps.parameterSpace.taskParameterDefinitions.chunks.defaultTaskCount
steps.parameterSpace.taskParameterDefinitions.chunks.rangeConstraint
steps.parameterSpace.taskParameterDefinitions.name
steps.parameterSpace.taskParameterDefinitions.range
steps.parameterSpace.taskParameterDefinitions.type
steps.script
steps.script.actions
steps.script.actions.onRun
steps.script.actions.onRun.args
steps.script.actions.onRun.cancelation
steps.script.actions.onRun.cancelation.mode
steps.script.actions.onRun.cancelation.notifyPeriodInSeconds
steps.script.actions.onRun.command
steps.script.actions.onRun.timeout]], table.concat(list, "\n"))
  end)

  it("is held against rules that refuse what is wrong", function()
    local text = done "farm film.lua --openjd -o o/#.png --job-time 1 --workers 2"
    local function refuses(change)
      local job = assert(json.decode(text))
      change(job, job.steps[1], job.steps[1].script.actions.onRun,
        job.steps[1].parameterSpace.taskParameterDefinitions[1])
      return not pcall(openjd.check, job)
    end
    assert.is_false(refuses(function() end))
    for _, change in ipairs {
      function(job) job.extensions = nil end,
      function(job) job.name = "{{Param.Script}}" end,
      function(job) job.name = "a\u{85}" end,
      function(job) job.comment = "mine" end,
      function(job) job.steps = {} end,
      function(job) job.steps[2] = job.steps[1] end,
      function(job) job.parameterDefinitions[1].default = ("x"):rep(1025) end,
      function(job) job.parameterDefinitions[1].name = "a-b" end,
      function(job) job.parameterDefinitions[2].objectType = "LINK" end,
      function(job) job.parameterDefinitions[3].name = job.parameterDefinitions[2].name end,
      function(job) job.parameterDefinitions[1].allowedValues = { "other" } end,
      function(job) job.parameterDefinitions[1].description = "" end,
      function(_, step) step.dependencies = { { dependsOn = "Join" } } end,
      function(_, step) step.hostRequirements.amounts[1].min = "2" end,
      function(_, step) step.hostRequirements.amounts[1].min = 0 end,
      function(_, step) step.script.actions.onExit = step.script.actions.onRun end,
      function(_, _, run) run.args[1] = "a}}" end,
      function(_, _, run) run.args[1] = "{{Param.None}}" end,
      function(_, _, run) run.args[1] = "a\tb" end,
      function(_, _, run) run.timeout = 0 end,
      function(_, _, run) run.cancelation.notifyPeriodInSeconds = 601 end,
      function(_, _, run) run.command = nil end,
      function(_, _, _, task) task.range = "1-" end,
      function(_, _, _, task) task.range = "{{Param.Script}}" end,
      function(_, _, _, task) task.chunks.rangeConstraint = "ANY" end,
      function(_, _, _, task) task.chunks.defaultTaskCount = 0 end,
    } do
      assert.is_true(refuses(change))
    end
  end)

  local it_selects = present.program "jq" and it or pending
  it_selects("has its paths as values, by the line in the page", function()
    local page = system.read "docs/farm.md"
    bench:write("job.json", done "farm film.lua --openjd -o o/#.png")
    assert.equal(0, (shell(assert(page:match "\n(jq [^\n]*)"))))
    local values = assert(json.decode(bench:read "values.json"))
    assert.same({ Script = bench.folder .. "/film.lua", Folder = bench.folder,
                  Output = bench.folder .. "/o" }, values)
  end)
end)
