-- celspan farm --openjd: the template is compared with the specification, and run with its
-- parameters filled in.
local farm = require "tests.support.farm"
local json = require "celspan.json"
local openjd = require "tests.support.openjd"

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
end)
