--- Runs the programs of the benchmark, interleaved, and keeps their results as rows.
local system = require "tests.support.system"

local Runner = {}
Runner.__index = Runner

--- A row of the table that is written: these columns in this order.
Runner.columns = {
  "part", "scene", "side", "output", "antialias", "renderer", "workers", "wall", "best_wall",
  "processor", "best_processor", "instructions", "runs", "peak_kib", "spans", "colours",
  "crossings", "bytes", "is_part", "is_over", "rms", "worst", "over_two", "pixels", "leaking",
  "load", "lines",
}

--- programs: the folder of the built ones; seconds: how long a program may repeat a job; share: the
--- share of the requested rounds to run.
function Runner.new(options)
  return setmetatable({ rows = {}, notes = {}, programs = options.programs,
    seconds = options.seconds, share = options.share, pictures = {} }, Runner)
end

function Runner:program(name) return self.programs .. "/bench_" .. name end

function Runner:has(name)
  local file = io.open(self:program(name))
  if file then file:close() end
  return file ~= nil
end

--- Reports once that something is left out.
function Runner:note(text)
  if self.notes[text] then return end
  self.notes[text] = true
  self.notes[#self.notes + 1] = text
  print("   " .. text)
end

local function load_average()
  local file = io.open "/proc/loadavg"
  if not file then return 0 end
  local load = file:read "n"
  file:close()
  return load
end

local hexadecimal = { picture = true, digest = true }


function Runner.command(...)
  local words = {}
  for i, word in ipairs { ... } do words[i] = system.quote(word) end
  return table.concat(words, " ")
end

--- The output of a command, a table for each line of `KEY VALUE` pairs; nil and its message when it
--- fails. A command that takes longer than `limit` seconds is ended, and the message says so.
function Runner:ask(command, limit)
  local guard = limit and ("timeout %d "):format(limit) or ""
  local pipe = assert(io.popen(("BENCH_SECONDS=%g %s%s 2>&1"):format(self.seconds, guard, command)))
  local text = pipe:read "a"
  local is_good, _, code = pipe:close()
  if limit and code == 124 then
    return { { wall = limit, best_wall = limit, processor = limit, best_processor = limit,
               is_over = 1 } }
  end
  if not is_good then return nil, text:match "[^\n]*" end
  local lines = {}
  for line in text:gmatch "[^\n]+" do
    local pairs_told = {}
    for key, value in line:gmatch "([%a_]+) (%S+)" do
      pairs_told[key] = not hexadecimal[key] and tonumber(value) or value
    end
    lines[#lines + 1] = pairs_told
  end
  return lines
end

local function median(list)
  table.sort(list)
  return list[#list // 2 + 1]
end

--- Folds the results of several rounds into one row.
local function fold(entry, told)
  local row = {}
  for key, value in pairs(entry) do row[key] = value end
  local lists = { wall = {}, best_wall = {}, processor = {}, best_processor = {},
                  instructions = {} }
  row.runs = 0
  for _, line in ipairs(told) do
    for key, list in pairs(lists) do list[#list + 1] = line[key] end
    row.runs = row.runs + (line.runs or 1)
    row.peak_kib = math.max(row.peak_kib or 0, line.peak_kib or 0)
    for _, key in ipairs { "spans", "colours", "crossings", "bytes", "picture", "digest",
                            "is_over" } do
      row[key] = line[key] or row[key]
    end
  end
  row.wall, row.processor = median(lists.wall), median(lists.processor)
  row.instructions = median(lists.instructions) -- nil where none were counted
  row.best_wall, row.best_processor = math.min(table.unpack(lists.best_wall)),
    math.min(table.unpack(lists.best_processor))
  return row
end

local function show(row)
  local line = "   %-9s %-9s %7s %-7s %-5s %-22s %10.3f ms  processor %10.3f ms  %7.1f MiB"
  print(line:format(row.part, row.scene, row.side, row.output, row.antialias or "", row.renderer,
    1e3 * row.wall, 1e3 * row.processor, (row.peak_kib or 0) / 1024))
end

--- entries: { { command =, renderer =, ... }, ... }, each with the columns of its row; run in turn,
--- `rounds` times. `take(lines)` picks a line of an entry's output, the first one by default.
function Runner:repeat_all(rounds, entries)
  local told = {}
  for _ = 1, rounds do
    for i, entry in ipairs(entries) do
      local lines, message = self:ask(entry.command, entry.limit)
      local line = lines and (entry.take or function(l) return l[1] end)(lines)
      if line and line.wall then
        told[i] = told[i] or {}
        table.insert(told[i], line)
      else
        self:note(("%s, %s at %s: %s"):format(entry.renderer, entry.scene, entry.side,
          message or "no output"))
      end
    end
  end
  for i, entry in ipairs(entries) do
    if told[i] then
      local row = fold(entry, told[i])
      row.load, row.take, row.command, row.limit = load_average(), nil, nil, nil
      self.rows[#self.rows + 1] = row
      show(row)
    end
  end
end

--- The same, with fewer rounds in a quick run.
function Runner:measure(rounds, entries)
  self:repeat_all(math.max(1, math.floor(rounds * self.share + 0.5)), entries)
end

--- Notes in the rows from `first` on how far their pictures are from celspan's, blended alike.
function Runner:compare(first)
  local truth
  for i = first, #self.rows do
    local row = self.rows[i]
    if row.renderer == "celspan" then truth = row.picture or truth
    elseif truth and row.picture then row.rms = self.distance(truth, row.picture) end
  end
end

--- How far two pictures are apart as cells: the root of the mean square, of 255.
function Runner.distance(a, b)
  local sum, count = 0, #a // 2
  for i = 1, #a, 2 do
    local difference = tonumber(a:sub(i, i + 1), 16) - tonumber(b:sub(i, i + 1), 16)
    sum = sum + difference * difference
  end
  return math.sqrt(sum / count)
end

--- Whether any program had access to an instruction counter.
function Runner:has_counter()
  for _, row in ipairs(self.rows) do
    if row.instructions then return true end
  end
  return false
end

function Runner:write(path)
  local file = assert(io.open(path, "w"))
  file:write(table.concat(Runner.columns, ","), "\n")
  for _, row in ipairs(self.rows) do
    local cells = {}
    for i, column in ipairs(Runner.columns) do
      local value = row[column]
      cells[i] = value == nil and "" or math.type(value) == "float" and ("%.6g"):format(value)
        or tostring(value)
      assert(not cells[i]:find ",", "a cell of the table has a comma")
    end
    file:write(table.concat(cells, ","), "\n")
  end
  assert(file:close())
end

return Runner
