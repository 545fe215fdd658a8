-- celspan farm: its script for Slurm is run as Slurm would run an array, and its commands by a
-- shell and by engines. openjd_spec.lua has the template of Open Job Description.
local farm = require "tests.support.farm"
local json = require "celspan.json"
local openjd = require "tests.support.openjd"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local celspan, done, frames_in, refused, same, shell, word =
  farm.celspan, farm.done, farm.frames_in, farm.refused, farm.same, farm.shell, farm.word

local bench

before_each(function() bench = farm.begin() end)
after_each(farm.finish)

-- ---------------------------------------------------------------- Slurm

local function slurm(arguments)
  bench:write("job.sh", done("farm film.lua --slurm " .. arguments))
  assert.equal(0, (shell "bash -n job.sh"))
  return bench:read "job.sh"
end

--- The exit status of a task's script. more: parts of the environment, such as the number of
--- requeues.
local function run_task(number, more, script)
  local place = word(bench.folder)
  return shell(("cd / && env SLURM_ARRAY_TASK_ID=%d SLURM_ARRAY_JOB_ID=7 SLURM_CPUS_ON_NODE=1 %s "
    .. 'PATH=%s:"$PATH" bash %s/job.sh %s'):format(number, more or "", place, place, script or ""))
end

local function directives(text)
  local found = {}
  for line in text:gmatch "#SBATCH %-%-([^\n]*)" do found[#found + 1] = line end
  return found
end

local function count_of(text) return tonumber(text:match "array=1%-(%d+)") end

describe("the script for Slurm", function()
  it("makes every frame once, whatever the chunk", function()
    done "render film.lua -o whole/####.png --progress none"
    for chunk, tasks in pairs { [1] = 7, [2] = 4, [3] = 3, [7] = 1, [100] = 1 } do
      os.execute("rm -rf " .. bench.folder .. "/out")
      assert.equal(tasks, count_of(slurm("-o out/####.png --chunk " .. chunk)))
      for i = 1, tasks do
        local before = #bench:files "out"
        local code, _, err = run_task(i)
        assert.equal(0, code, err)
        assert.is_true(#bench:files "out" > before, "a task without frames")
      end
      assert.equal("0003.png 0004.png 0005.png 0006.png 0007.png 0008.png 0009.png",
        frames_in "out")
      for i = 3, 9 do same(("out/%04d.png"):format(i), ("whole/%04d.png"):format(i)) end
    end
  end)

  it("passes options and arguments on, with quotes where necessary", function()
    local odd = [[it's "a" $HOME `id` \ * é]] .. "\n  end \nof it"
    assert.equal(true, os.execute("mkdir " .. word(bench.folder .. "/" .. odd)))
    local arguments = ("-o %s --frames 5,3 --size 30x20 --scale 0.5"):format(word(odd .. "/#.png"))
    refused("--size and --scale", "farm film.lua --slurm " .. arguments)
    arguments = arguments:gsub(" %-%-scale 0.5", "") .. " --limit time=9,memory=64M --allow "
      .. word(odd) .. " --background=#102030 --antialias none -- 7.5 " .. word(odd)
    assert.equal(1, count_of(slurm(arguments)))
    assert.equal(0, (run_task(1)))
    assert.equal("3.png 5.png", frames_in(odd))
    done("render film.lua -o whole/#.png --frames 5,3 --size 30x20 --background '#102030'"
      .. " --antialias none -- 7.5")
    same(odd .. "/5.png", "whole/5.png")
  end)

  it("passes on the options for the script's rights", function()
    slurm "-o out/#.png --frames 3"
    bench:write("film.lua", "assert(os.execute)\n" .. farm.FILM)
    assert.equal(3, (run_task(1)))
    slurm "-o out/#.png --frames 3 --trust"
    assert.equal(0, (run_task(1)))
  end)

  it("requests the given resources, and nothing else", function()
    assert.same({ "job-name=film", "array=1-1", "requeue", "open-mode=append" },
      directives(slurm "-o out/#.png"))
    local text = slurm("-o out/#.png --job-name 'a b\n;c' --job-memory 900 --job-time 45"
      .. " --workers 3 --logs 'some logs%'")
    assert.same({ "job-name=a-b--c", "array=1-1", "requeue", "open-mode=append", "cpus-per-task=3",
                  "mem=900M", "time=45",
                  ('output="%s/some logs%%%%/%%x-%%A_%%a.log"'):format(bench.folder) },
      directives(text))
    local memory = "\nexport CELSPAN_MEMORY=${CELSPAN_MEMORY:-900M} # as --mem\n"
    assert.is_truthy(text:find(memory, 1, true), text)
    assert.is_nil(slurm "-o out/#.png":find("CELSPAN_MEMORY", 1, true))
    refused("--logs: Slurm takes no name", "farm film.lua -o o/#.png --slurm --logs 'a\"b'")
    refused("--logs: Slurm takes no name", "farm film.lua -o o/#.png --slurm --logs 'a\nb'")
  end)

  it("resumes where a task was stopped", function()
    slurm "-o out/#.png --chunk 4"
    run_task(1)
    os.remove(bench.folder .. "/out/4.png")
    local code, _, err = run_task(1)
    assert.equal(0, code)
    assert.is_truthy(bench:read "out/4.png")
    assert.is_truthy(err:find("2 kept", 1, true), err)
  end)

  it("requests another try if one may help, but not endlessly", function()
    slurm "-o out/#.png"
    bench:write("scontrol", '#!/bin/sh\necho "$@" >> scontrol.log\n')
    bench:write("sleep", "#!/bin/sh\necho slept >> scontrol.log\n") -- until Slurm ends it
    bench:write("fake", '#!/bin/sh\nexit "${FAKE}"\n')
    shell "chmod +x scontrol sleep fake"
    local function tries(code, more)
      os.remove(bench.folder .. "/scontrol.log")
      local got = run_task(1, ("FAKE=%d CELSPAN=%s %s"):format(code, word(bench.folder .. "/fake"),
        more or ""))
      return got, bench:read "scontrol.log"
    end
    for _, code in ipairs { 5, 33, 137 } do
      local got, log = tries(code)
      assert.equal(code, got)
      assert.equal("requeue 7_1\nslept\n", log)
      assert.same({ code }, { tries(code, "SLURM_RESTART_COUNT=3") })
    end
    for _, code in ipairs { 0, 1, 2, 3, 4, 6, 70, 143 } do
      assert.same({ code }, { tries(code) })
    end
  end)

  it("gives each task a log of its own", function()
    slurm "-o out/####.png --chunk 4 --log run"
    for i = 1, 2 do
      local code, _, err = run_task(i)
      assert.equal(0, code, err)
    end
    for i = 1, 2 do assert.is_truthy(bench:read("run." .. i):find(": ends: ", 1, true)) end
    slurm "-o one.png --frames 3 --size 60x700 --strips 2 --log run.log"
    assert.equal(0, (run_task(2)))
    assert.is_truthy(bench:read("run.2.log"):find(": ends: ", 1, true))
  end)

  it("submits itself to the queue", function()
    slurm "-o out/#.png --logs 'my logs'"
    bench:write("sbatch",
      '#!/bin/sh\nprintf "%s|" "$@" >> sbatch.log\necho >> sbatch.log\necho 42\n')
    local function queue()
      os.remove(bench.folder .. "/sbatch.log")
      assert.equal(0, (shell 'chmod +x sbatch && PATH=.:"$PATH" bash job.sh'))
      return bench:read "sbatch.log"
    end
    assert.equal("job.sh|\n", queue())
    assert.same({}, bench:files "my logs")
    assert.equal(0, (shell "test -d 'my logs'"))
    slurm "-o one.png --frames 3 --size 60x600 --strips 2"
    assert.equal("--parsable|job.sh|\n--array=1|--dependency=afterok:42|--kill-on-invalid-dep=yes|"
      .. "job.sh|join|\n", queue())
  end)

  it("makes strips of a frame, and joins them", function()
    for _, ending in ipairs { "png", "tga", "span" } do
      local odd = "a 'b'/shot.####." .. ending
      local text = slurm("-o " .. word(odd) .. " --frames 4 --size 70x1100 --strips 3")
      assert.equal(3, count_of(text))
      for i = 1, 3 do
        local code, _, err = run_task(i)
        assert.equal(0, code, err)
      end
      local code, _, err = run_task(1, "", "join")
      assert.equal(0, code, err)
      done("render film.lua -o whole." .. ending .. " --frames 4 --size 70x1100")
      local joined = "a 'b'/shot.0004." .. ending
      if ending == "png" then
        assert.is_truthy(bench:read(joined):find("IEND", 1, true))
      else
        same(joined, "whole." .. ending)
      end
      os.remove(bench.folder .. "/" .. joined)
      assert.equal(0, (shell "env -u SLURM_ARRAY_TASK_ID bash job.sh join")) -- by hand
      assert.is_truthy(bench:read(joined))
    end
  end)

  it("warns about arrays that Slurm may not accept", function()
    bench:write("long.lua", farm.FILM:gsub("frames = 7", "frames = 5000"))
    local _, _, err = celspan "farm long.lua -o out/#.png --slurm --chunk 2"
    assert.is_truthy(err:find("2500 tasks: Slurm takes arrays of 1000", 1, true), err)
    _, _, err = celspan "farm long.lua -o out/#.png --slurm --chunk 5"
    assert.equal("", err)
  end)
end)

-- ---------------------------------------------------------------- tables

local TABLE = "name,radius\nred,5\nblue,12\n\"the 'big' one\",30\n"

describe("a job of a table", function()
  before_each(function()
    bench:write("set.lua", [[
      local celspan = require "celspan"
      local p = celspan.parameters { radius = 10 }
      return celspan.film { size = { 60, 40 }, frames = 2, frame = function(f)
        return celspan.rostrum { celspan.cel { celspan.circle { centre = { 20 * f.number, 20 },
          radius = p.radius, texture = "#c04030" } } }
      end }]])
    bench:write("night.csv", TABLE)
    done "render set.lua -o 'w/{name}/#.png' --table night.csv"
  end)

  local function check_films(folder)
    for _, name in ipairs { "red", "blue", "the 'big' one" } do
      for i = 1, 2 do
        same(("%s/%s/%d.png"):format(folder, name, i), ("w/%s/%d.png"):format(name, i))
      end
    end
  end

  local OPTIONS = "farm set.lua -o '%s/{name}/#.png' --table night.csv "

  it("makes every film once, by each way", function()
    bench:write("lines.sh", done(OPTIONS:format "a" .. "--commands"))
    assert.equal(3, select(2, bench:read "lines.sh":gsub("\n", "")))
    assert.equal(0, (shell "sh lines.sh"))
    check_films "a"
    bench:write("job.sh", done(OPTIONS:format "b" .. "--slurm --chunk 2"))
    assert.equal(2, count_of(bench:read "job.sh"))
    for i = 1, 2 do
      local before = #bench:files "b"
      local code, _, err = run_task(i)
      assert.equal(0, code, err)
      assert.is_true(#bench:files "b" > before)
    end
    check_films "b"
    local job = assert(json.decode(done(OPTIONS:format "c" .. "--openjd")))
    openjd.check(job)
    assert.equal("3 films of set.lua in 3 tasks", job.description:match "^(.-),")
    openjd.run(job, bench)
    check_films "c"
  end)

  it("makes the rows of its task, and checks all", function()
    local function task(share)
      local _, _, err = celspan("render set.lua -o 'd/{name}.png' --frames 1 --table night.csv "
        .. "--task " .. share)
      return err
    end
    assert.is_truthy(task "1/3":find("1/1 d/red.png", 1, true))
    assert.is_truthy(task "2/2":find("2/2 d/the 'big' one.png", 1, true))
    assert.is_truthy(task "1/9":find("task 1 of 9 has no rows", 1, true))
    bench:write("night.csv", TABLE:gsub("30", "x"))
    assert.is_truthy(task "1/3":find("line 4", 1, true))
    refused("line 4", OPTIONS:format "a" .. "--commands")
  end)

  it("refuses what the run of a row would refuse", function()
    local refusals = {
      ["-o '{name}.xyz'"] = "cannot be written",
      ["-o '{name}.png' --frames 1 --max-size 2M"] = "png takes no --max-size",
      ["-o '{name}.mp4' --fit cover"] = "give --size",
      ["-o '{name}.mp4' --size 61x41"] = "needs an even width and height",
      ["-o '{name}.mp4' --codec ffv1"] = "mp4 contains",
      ["-o '{name}-#.mp4'"] = "leave the frame's number out",
    }
    for options, text in pairs(refusals) do
      refused(text, "farm set.lua --table night.csv --commands " .. options)
    end
    bench:write("formats.csv", "name,ending\na,png\nb,xyz\n")
    refused("b.xyz: the format \"xyz\"",
      "farm set.lua --table formats.csv --commands -o '{name}.{ending}' --frames 1")
    done "farm set.lua --table night.csv --commands -o '{name}.mp4' --size 60x40 --codec h264"
    done "farm set.lua --table night.csv --commands -o '{name}.mp4' --keep-going"
  end)

  it("leaves sizes that are not given to the rows, whose films have their own", function()
    bench:write("sized.lua", [[
      local celspan = require "celspan"
      local p = celspan.parameters { side = 41 }
      return celspan.film { size = { p.side, p.side }, frames = 1, frame = function()
        return celspan.rostrum { back = "#fff" }
      end }]])
    bench:write("sizes.csv", "side\n40\n")
    local arguments = "sized.lua -o o.mp4 --table sizes.csv"
    done("farm --commands " .. arguments)
    done("render " .. arguments)
  end)

  it("may make videos, and no strips", function()
    assert.is_truthy(done("farm set.lua -o '{name}.mp4' --table night.csv --commands --quality 9")
      :find("--table night.csv --quality 9", 1, true))
    refused("--table divides its rows", OPTIONS:format "a" .. "--commands --strips 2")
    bench:write("same.csv", "radius\n5\n12\n")
    refused("lines 2 and 3 would both make", "farm set.lua -o o.mp4 --table same.csv --slurm")
    local code, _, err = celspan "farm set.lua -o '{name}.mp4' --table no.csv --slurm"
    assert.equal(4, code)
    assert.is_truthy(err:find("no.csv", 1, true))
  end)
end)

-- ---------------------------------------------------------------- commands

describe("the commands of a job", function()
  it("make every frame once, on whatever runs lines", function()
    done "render film.lua -o all/#.png"
    local lines = done "farm film.lua -o o/#.png --commands --chunk 2 --workers 1"
    assert.equal(4, select(2, lines:gsub("\n", "")))
    bench:write("lines.sh", lines)
    assert.equal(0, (shell "sh lines.sh"))
    assert.equal(frames_in "all", frames_in "o")
    for name in frames_in("all"):gmatch "%S+" do same("all/" .. name, "o/" .. name) end
  end)

  it("make strips of a frame, and join them", function()
    local options = "film.lua --frames 3 --size 60x700 -- 7"
    done("render -o whole.tga " .. options)
    bench:write("lines.sh", done("farm -o one.tga --commands --strips 2 " .. options))
    assert.equal(0, (shell "sh lines.sh"))
    same("whole.tga", "one.tga")
  end)

  it("give each task a log of its own", function()
    assert.equal(0, (bench:inside "mkdir logs"))
    for way, count in pairs { ["-o o/#.png --chunk 3"] = 3, ["-o s.png --strips 2 --frames 3"
      .. " --size 60x700"] = 2 } do
      bench:write("lines.sh", done("farm film.lua --commands --log logs/a\\ b.log " .. way))
      assert.equal(0, #bench:files "logs")
      assert.equal(0, (shell "sh lines.sh"))
      for i = 1, count do
        local text = bench:read(("logs/a b.%d.log"):format(i))
        assert.equal(1, select(2, text:gsub(": begins: ", "")))
        assert.is_truthy(text:find(": frame %d+: "), text)
      end
      assert.equal(count, #bench:files "logs")
      assert.equal(0, (bench:inside "rm logs/*"))
    end
  end)

  it("have quotes around words that zsh replaces", function()
    local lines = done "farm film.lua -o o/#.png --commands -- =ls a=b"
    assert.truthy(lines:find(" -- '=ls' a=b\n", 1, true), lines)
  end)

  it("need one line each", function()
    refused("has control characters", "farm film.lua -o o/#.png --commands -- 'a\nb'")
    refused("has control characters", "farm film.lua -o 'o\n/#.png' --commands")
    bench:write("a\nb.lua", farm.FILM)
    refused("has control characters", "farm 'a\nb.lua' -o o/#.png --commands")
  end)
end)

-- ---------------------------------------------------------------- arrays

--- What engines say in the environment of task i of n, i from 1.
local ARRAYS = {
  ["Slurm"] = { "env", function(i, n)
    return ("SLURM_ARRAY_TASK_ID=%d SLURM_ARRAY_TASK_MIN=0 SLURM_ARRAY_TASK_MAX=%d "
      .. "SLURM_ARRAY_TASK_STEP=5"):format(5 * (i - 1), 5 * (n - 1))
  end },
  ["Grid Engine"] = { "env", function(i, n)
    return ("SGE_TASK_ID=%d SGE_TASK_FIRST=1 SGE_TASK_LAST=%d SGE_TASK_STEPSIZE=1"):format(i, n)
  end },
  ["AWS Batch"] = { "env", function(i, n)
    return ("AWS_BATCH_JOB_ARRAY_INDEX=%d AWS_BATCH_JOB_ARRAY_SIZE=%d"):format(i - 1, n)
  end },
  ["Kubernetes"] = { "env/24", function(i) return "JOB_COMPLETION_INDEX=" .. i - 1 end },
}

describe("an array without a script", function()
  --- Runs a task of an array of 24. Returns what shell does.
  local function run(array, i)
    return shell(("env %s \"$CELSPAN\" render long.lua -o o/#.png --progress none --task %s")
      :format(array[2](i, 24), array[1]))
  end

  before_each(function()
    bench:write("long.lua", (farm.FILM:gsub("frames = 7, first = 3", "frames = 240")))
  end)

  for name, array in pairs(ARRAYS) do
    it("makes each of 240 frames in one task: " .. name, function()
      local before = 0
      for i = 1, 24 do
        local code, _, err = run(array, i)
        assert.equal(0, code, err)
        assert.equal(before + 10, #bench:files "o")
        before = #bench:files "o"
      end
    end)

    it("refuses numbers outside of the array: " .. name, function()
      for _, i in ipairs { 0, 25 } do
        local code, out, err = run(array, i)
        assert.equal(2, code)
        assert.equal("", out)
        assert.is_truthy(err:find("--task: '" .. array[1] .. "' is not", 1, true), err)
      end
    end)
  end

  it("needs the variables of an engine", function()
    refused("--task: 'env' is not", "render long.lua -o o/#.png --task env")
    refused("--task: 'env/24' is not", "render long.lua -o o/#.png --task env/24")
  end)
end)

-- ---------------------------------------------------------------- engines

--- The block of code of docs/farm.md that contains a text.
local function example(text)
  local file = assert(io.open "docs/farm.md")
  local page = file:read "a"
  file:close()
  for block in page:gmatch "\n```%w+\n(.-)```" do
    if block:find(text, 1, true) then return block end
  end
  error("docs/farm.md has no example with " .. text)
end

describe("the examples of engines", function()
  before_each(function()
    bench:write("film.lua", (farm.FILM:gsub("frames = 7, first = 3", "frames = 240")))
    done "render film.lua -o whole/shot.####.png --progress none"
  end)

  --- Runs an example, with the program that is tested as `celspan`, and compares all frames.
  local function check_frames(commands)
    bench:write("example.sh", commands)
    bench:shell(("ln -sf %s %s/celspan"):format(word(workbench.absolute), word(bench.folder)))
    local code, _, err = shell('export HOME="$PWD" PATH="$PWD:$PATH" && unset CELSPAN && '
      .. "sh -e example.sh")
    assert.equal(0, code, err)
    for i = 1, 240 do
      same(("out/shot.%04d.png"):format(i), ("whole/shot.%04d.png"):format(i))
    end
  end

  local it_in_parallel = present.program "parallel" and it or pending
  it_in_parallel("run in GNU parallel", function()
    check_frames(example "--commands" .. example "parallel -j")
    assert.equal(12 + 1, select(2, bench:read "log.txt":gsub("\n", "")))
  end)

  local it_in_snakemake = present.program "snakemake" and it or pending
  it_in_snakemake("run in Snakemake", function()
    bench:write("Snakefile", example "rule task")
    check_frames(example "--commands" .. example "snakemake --cores")
    assert.equal(12, #bench:files "tasks")
  end)
end)

describe("celspan farm", function()
  it("refuses more options than a task accepts, and names that are too long", function()
    refused("--scale: there are more than 128 options",
      "farm film.lua --slurm -o out/####.png" .. (" --scale 1"):rep(129))
    refused("the name is too long", "farm film.lua --slurm -o " .. ("x/"):rep(2100) .. "####.png")
  end)

  it("ends with 4 in a folder that was deleted", function()
    local code, _, err =
      shell('mkdir gone && cd gone && rmdir ../gone && "$CELSPAN" farm ../film.lua --slurm -o '
      .. 'out/####.png')
    assert.equal(4, code)
    assert.is_truthy(err:find("the current folder has no name: No such file or directory", 1, true),
      err)
  end)

  it("refuses impossible options before it makes a job", function()
    refused("-o is missing", "farm film.lua --slurm")
    refused("for which farm?", "farm film.lua -o o/#.png")
    refused("for which farm?", "farm film.lua -o o/#.png --slurm --openjd")
    refused("give one of them", "farm film.lua -o o/#.png --slurm --chunk 2 --strips 2")
    refused("--chunk: '0'", "farm film.lua -o o/#.png --slurm --chunk 0")
    refused("a farm makes files", "farm film.lua -o - --slurm")
    refused("a farm makes files", "farm film.lua -o o.mp4 --slurm")
    refused("several frames (7) need a number", "farm film.lua -o o.png --slurm")
    refused("frame 99", "farm film.lua -o o/#.png --frames 99 --slurm")
    refused("there are 7", "farm film.lua -o o/#.png --strips 2 --slurm")
    refused("makes at most 3",
      "farm film.lua -o o.png --frames 3 --size 60x700 --strips 4 --slurm")
    refused("at most 1000 strips", "farm film.lua -o o.png --frames 3 --strips 1001 --slurm")
    refused("unknown option '--resume'", "farm film.lua -o o/#.png --slurm --resume")
    for _, name in ipairs { "none/run.log", "''", "/", "film.lua/run.log" } do
      refused("--log", "farm film.lua -o o/#.png --slurm --log " .. name)
    end
    bench:write("bad.lua", "error 'bad'")
    assert.equal(3, (celspan "farm bad.lua -o o/#.png --slurm"))
    assert.equal(4, (celspan "farm none.lua -o o/#.png --slurm"))
  end)

  it("says how a video is made of the frames, with its rate and its sound", function()
    local how = "give -o my film.####.png, and when all are there, make the video of them: celspan "
      .. "convert 'my film.####.png' 'my film.mp4' --fps "
    bench:write("film.lua", (farm.FILM:gsub("frames = 7", "fps = 30000 / 1001, frames = 7")))
    refused(how .. "30000/1001\n", "farm film.lua -o 'my film.mp4' --slurm")
    bench:write("film.lua", (farm.FILM:gsub("frames = 7", "fps = 12, sound = 'a.wav', frames = 7")))
    refused(how .. "12 --sound film.lua\n", "farm film.lua -o 'my film.mp4' --slurm")
  end)

  it("refuses what every task would refuse", function()
    for options, text in pairs {
      ["-o o.#.png --quality 50"] = "png takes no --quality",
      ["-o o.#.png --fps 12"] = "png takes no --fps",
      ["-o o.#.png --loudness -14"] = "png takes no --loudness",
      ["-o o.#.tif --layers cels"] = "tif takes no --layers",
      ["-o o.#.exr --layers cels --colour rec709"] = "exr with layers takes --colour linear",
      ["-o o.#.png --dither --depth 16"] = "--dither makes 8 bits",
      ["-o o.plane"] = "one plane file holds all frames, and is made in one run",
      ["-o o.plane --keep-going"] = "one plane file holds all frames",
      ["-o o.#.xyz"] = "cannot be written",
      ["-o o.#.svg"] = "svg is for drawings, which 'celspan render' makes",
      ["-o o.#.pdf"] = "pdf is for drawings, which 'celspan render' makes",
      ["-o o.#.x --format svg"] = "svg is for drawings",
      ["-o o.json"] = "json is for Lottie animations",
      ["-o o.#.png --fit cover"] = "give --size",
      ["-o o.#.png --crop 50,0,20,20"] = "is not within the frame",
    } do
      refused(text, "farm film.lua --commands " .. options)
    end
    for _, options in ipairs { "--colour linear --layers cels -o o.#.exr", "--force -o o.#.png",
                               "--keep-going --depth 16 -o o.#.png" } do
      done("farm film.lua --commands " .. options)
    end
  end)

  it("refuses formats whose strips cannot be joined", function()
    local code, _, err =
      celspan "farm film.lua -o o.exr --frames 3 --size 60x700 --strips 2 --slurm"
    assert.equal(2, code)
    assert.is_truthy(err:find("takes no --strip: leave it out; it is only for pictures (png", 1,
      true), err)
  end)
end)
