-- The rows of --table as an orchestrator sees them: events, logs, faults of single rows, and what
-- is left when the run ends early.
local json = require "celspan.json"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local bench

--- A film that fails for n = 5, and of which each frame after the first takes for ever for n = 9.
--- It says that it has begun by a file with the number of its process.
local FILM = [[
  local celspan = require "celspan"
  local p = celspan.parameters { id = "", n = { 0, min = 0, max = 10 } }
  print("film", p.id)
  return celspan.film { size = { 16, 16 }, frames = 2, frame = function(f)
    if p.n == 5 then error "five" end
    if p.n == 9 and f.number == 2 then
      local said = assert(io.open(p.id .. ".begun", "w"))
      said:write(io.open("/proc/self/stat"):read "n")
      said:close()
      while true do end
    end
    return celspan.rostrum { celspan.cel { celspan.rect { f.number, p.n, 4, 4 } } }
  end }
]]

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", FILM)
end)
after_each(function() bench:remove() end)

--- Renders the rows of a table. Returns the exit code, and standard error.
local function render(rows, options)
  bench:write("rows.csv", rows)
  local code, _, err = bench:celspan_inside("render film.lua -o '{id}.plane' --table rows.csv "
    .. options)
  return code, err
end

--- The events of --progress json of these kinds; every line must be an object.
local function events(text, ...)
  local found, wanted = {}, {}
  for _, kind in ipairs { ... } do wanted[kind] = true end
  for line in text:gmatch "[^\n]+" do
    local event = assert(json.decode(line), line)
    if wanted[event.event] then found[#found + 1] = event end
  end
  return found
end

--- Begins a run whose rows called a and b take for ever, and calls `act` of the shell when these
--- rows have begun: $pid is the run, $rows the rows.
local function interrupt(options, rows, act)
  return bench:inside(([[{
    '%s' render film.lua --trust --table rows.csv %s 2>said & pid=$!
    for row in %s; do
      for i in $(seq 200); do [ -s $row.begun ] && break; sleep 0.05; done
      rows="$rows $(cat $row.begun)"
    done
    %s
    }]]):format(workbench.absolute, options, rows, act))
end

--- Waits until the processes $all have ended; each that has not is printed.
local WAIT = [[
    for i in $(seq 200); do
      left=
      for one in $all; do
        case "$(ps -o stat= -p $one)" in ''|Z*) ;; *) left="$left $one" ;; esac
      done
      [ -z "$left" ] && break
      sleep 0.05
    done
    echo "left:$left"]]

describe("the rows of a table", function()
  it("end with the run, even when it is killed, and what they have started ends, too", function()
    local has_ffmpeg = present.program "ffmpeg"
    bench:write("rows.csv", "id,n\na,9\nb,9\n")
    local code, out, err = interrupt("--workers 2 --progress none -o '{id}."
      .. (has_ffmpeg and "mp4'" or "plane'"), "a b", [[
      all="$rows"
      for row in $rows; do all="$all $(pgrep -P $row | tr '\n' ' ')"; done
      set -- $all; echo "processes: $#"
      kill -KILL $pid; wait $pid]] .. "\n" .. WAIT)
    assert.equal(0, code, err)
    assert.truthy(tonumber(out:match "processes: (%d+)") >= (has_ffmpeg and 4 or 2), out)
    assert.truthy(out:find "left:\n", out .. err)
    for _, name in ipairs(bench:files()) do assert.is_nil(name:find "part$", name) end
  end)

  it("have not failed when a signal stops the run, whose exit code is in its last event", function()
    bench:write("rows.csv", "id,n\nc,1\na,9\nd,1\n")
    local code = interrupt("--workers 1 --keep-going --progress json -o '{id}.plane'", "a",
      "kill -TERM $pid; wait $pid")
    assert.equal(143, code)
    local last = events(bench:read "said", "end")[1]
    assert.same({ 143, 1, 3, 0, 0 }, { last.exit, last.done, last.count, last.failures,
      #last.failed })
  end)

  it("are counted alike in all events, each when it has ended", function()
    local code, err = render("id,n\na,1\nb,5\nc,2\nd,5\n", "--keep-going --progress json")
    assert.equal(1, code, err)
    local told = {}
    for i, one in ipairs(events(err, "row", "end")) do
      told[i] = ("%s %s %s %d %d %s"):format(one.event, one.line, one.how, one.done, one.failures,
        one.exit)
    end
    assert.same({ "row 2 made 1 0 nil", "row 3 failed 1 1 3", "row 4 made 2 1 nil",
      "row 5 failed 2 2 3", "end nil nil 2 2 1" }, told)
  end)

  it("are named in their messages, and so is what their script prints", function()
    local _, err = render("id,n\na,1\nb,5\n", "--keep-going --progress json")
    local found = {}
    for i, one in ipairs(events(err, "error", "note", "print")) do
      found[i] = ("%s %s %s %s"):format(one.event, one.line, one.output, one.message)
    end
    assert.same({ "print nil nil film\t", "print 2 a.plane film\ta", "print 3 b.plane film\tb",
      "error 3 b.plane film.lua:5: frame 1: five",
      "note 3 b.plane b.plane was not made: the run ended after 0 of 2 frames",
      "error 3 b.plane --table rows.csv: line 3 (b.plane): exit code 3" }, found)
  end)

  it("have logs of their own where --log names a column, and say there what they make", function()
    assert(os.execute("mkdir '" .. bench.folder .. "/logs'"))
    local code, err = render("id,n\na,1\nb,2\n", "--log 'logs/{id}.log'")
    assert.equal(0, code, err)
    assert.same({ "a.log", "b.log" }, bench:files "logs")
    local log = bench:read "logs/b.log"
    assert.truthy(log:find("note: begins: b.plane: 2 frames\n", 1, true), log)
    assert.truthy(log:find("note: ends: b.plane: 2 of 2 finished", 1, true), log)
    code, err = render("id,n\na,1\n", "--log 'logs/{name}.log'")
    assert.equal(2, code)
    assert.truthy(err:find("there is no column 'name' for {name} in --log; there are id, n", 1,
      true), err)
  end)

  it("fail alone with a value that is not allowed, under --keep-going and in check", function()
    local rows = "id,n\na,1\nb,140\nc,2\n"
    local why = "line 3 (b.plane): n is '140'; it must be a number from 0 to 10\n"
    local code, err, _ = render(rows, "--keep-going")
    assert.equal(1, code, err)
    assert.truthy(err:find("rows.csv: " .. why, 1, true), err)
    assert.truthy(bench:read "a.plane" and bench:read "c.plane")
    os.remove(bench.folder .. "/c.plane")
    code, err = render(rows, "")
    assert.equal(2, code, err)
    assert.is_nil(bench:read "c.plane")
    code, _, err = bench:celspan_inside "check film.lua --table rows.csv"
    assert.equal(2, code, err)
    assert.truthy(err:find("2 without a fault, 1 failed: line 3\n", 1, true), err)
    assert.falsy(err:find("warning: --table", 1, true), err)
    bench:write("rows.csv", "other\n1\n")
    code, _, err = bench:celspan_inside "check film.lua --table rows.csv"
    assert.equal(0, code, err)
    assert.truthy(err:find("rows.csv: no column is a parameter of the script; there are id, n", 1,
      true), err)
  end)

  it("come from standard input, and are not JSON", function()
    bench:write("rows.csv", "id,n\na,1\n")
    local code, _, err = bench:celspan_inside "render film.lua -o {id}.plane --table - < rows.csv"
    assert.equal(0, code, err)
    assert.truthy(bench:read "a.plane")
    code, err = render('{"id":"a","n":1}\n', "")
    assert.equal(4, code)
    assert.truthy(err:find("rows.csv: this is JSON, and a table is CSV: its first line has", 1,
      true), err)
    code, _, err = bench:celspan_inside "farm film.lua -o {id}.plane --slurm --table - < rows.csv"
    assert.equal(2, code)
    assert.truthy(err:find("--table -: each task reads the table, too", 1, true), err)
  end)

  it("have columns whose nearest name is suggested", function()
    local code, err = render("Id,n\na,1\n", "")
    assert.equal(2, code)
    assert.truthy(err:find("{Id} in OUT; did you mean 'id'?\n", 1, true), err)
  end)
end)

describe("what a script prints", function()
  it("is an event for each line in JSON, and a long line is several", function()
    bench:write("film.lua", [[
      print("one\ntwo", 3)
      print(("\u{e9}"):rep(600))
      print "a\0b\xff"
      local celspan = require "celspan"
      return celspan.film { size = { 8, 8 }, frames = 1, frame = function()
        return celspan.rostrum { celspan.cel {} }
      end }
    ]])
    for _, options in ipairs { "", " --trust" } do
      local code, _, err = bench:celspan_inside("render film.lua -o f.plane --progress json"
        .. options)
      assert.equal(0, code, err)
      local list = events(err, "print")
      for i, one in ipairs(list) do list[i] = one.message end
      assert.same({ "one", "two\t3", ("\u{e9}"):rep(512), ("\u{e9}"):rep(88), "a?b\u{fffd}" },
        list)
    end
  end)
end)

describe("the progress of", function()
  for verb, count in pairs { contact = 2, sprites = 2 } do
    it(verb .. " is reported as for other verbs", function()
      local code, _, err = bench:celspan_inside(verb .. " film.lua -o s.png --progress json")
      assert.equal(0, code, err)
      local frames, last = events(err, "frame"), events(err, "end")[1]
      assert.equal(count, #frames)
      assert.same({ 2, "s.png", "made", 2, 2 }, { frames[2].number, frames[2].output,
        frames[2].how, frames[2].done, frames[2].count })
      assert.same({ 2, 0 }, { last.done, last.exit })
      code, _, err = bench:celspan_inside(verb .. " film.lua -o s.png --set n=5 --progress json")
      assert.equal(3, code)
      assert.same({ 0, 3 }, { events(err, "end")[1].done, events(err, "end")[1].exit })
      bench:write("rows.csv", "id,n\na,1\n")
      code, _, err = bench:celspan_inside(verb .. " film.lua -o {id}.png --progress json --table "
        .. "rows.csv")
      assert.equal(0, code, err)
      assert.equal("a.png", events(err, "row")[1].output)
    end)
  end
end)
