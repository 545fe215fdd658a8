--- The table of a run, read back.
local Runner = require "tests.bench.runner"

local results = {}
results.__index = results

--- The peers that every page names, as rows and as people call them. Blend2D is not among them
--- because it is rarely installed.
results.peers = { { "skia", "Skia" }, { "agg", "AGG" }, { "qt", "Qt" }, { "cairo", "Cairo" } }

local numbers = { side = true, workers = true }
for i = 8, #Runner.columns do numbers[Runner.columns[i]] = true end

function results.read(path)
  local rows = {}
  local names
  for line in io.lines(path) do
    local cells = {}
    for cell in (line .. ","):gmatch "([^,]*)," do cells[#cells + 1] = cell end
    if not names then names = cells
    else
      local row = {}
      for i, name in ipairs(names) do
        local value = cells[i]
        if value ~= "" then row[name] = numbers[name] and tonumber(value) or value end
      end
      rows[#rows + 1] = row
    end
  end
  return setmetatable({ rows = rows }, results)
end

--- Rows whose columns are these.
function results:all(wanted)
  local list = {}
  for _, row in ipairs(self.rows) do
    local is_wanted = true
    for key, value in pairs(wanted) do is_wanted = is_wanted and row[key] == value end
    if is_wanted then list[#list + 1] = row end
  end
  return list
end

function results:one(wanted) return self:all(wanted)[1] end

--- Seconds of a row: processor time if there was one thread, which excludes waiting; else wall
--- time.
function results.seconds(row)
  if not row then return nil end
  return row.workers == 1 and row.processor or row.wall
end

--- The row of a drawing that became pixels in one reused row or band.
function results:pixel_row(scene, side, renderer, antialias)
  return self:one { part = "shapes", scene = scene, side = side, output = "row",
                    antialias = antialias, renderer = renderer }
end

--- A film's row. celspan has antialias "again" or "first", and output "row" by default or "whole".
function results:film_row(scene, side, renderer, antialias, output)
  return self:one { part = "film", scene = scene, side = side, renderer = renderer,
                    antialias = antialias, output = output or renderer == "celspan" and "row"
                    or "whole" }
end

--- The least seconds for one frame of a film.
function results:film_seconds(scene, side, renderer, antialias)
  local row = self:film_row(scene, side, renderer, antialias)
  return row and row.best_processor
end

--- The least seconds that seconds_of(a peer's name) gives, and how people call that peer.
local function least_of(seconds_of)
  local least, name
  for _, peer in ipairs(results.peers) do
    local taken = seconds_of(peer[1])
    if taken and (not least or taken < least) then least, name = taken, peer[2] end
  end
  return least, name
end

--- The seconds of the fastest peer, antialiased, and its name; nil where none was measured.
function results:best_peer(scene, side)
  return least_of(function(peer)
    return results.seconds(self:pixel_row(scene, side, peer, "area"))
  end)
end

--- The same for one frame of a film.
function results:best_film_peer(scene, side)
  return least_of(function(peer) return self:film_seconds(scene, side, peer, "area") end)
end

--- A prefix for a time: only a part was measured, or the run was ended before it was done.
function results.mark(row) return row.is_over and "over " or row.is_part and "~" or "" end

--- The power of the side that the time follows, by least squares over these sides.
function results:exponent(wanted, sides)
  local sx, sy, sxx, sxy, n = 0, 0, 0, 0, 0
  for _, side in ipairs(sides) do
    wanted.side = side
    local seconds = results.seconds(self:one(wanted))
    if seconds then
      local x, y = math.log(side), math.log(seconds)
      sx, sy, sxx, sxy, n = sx + x, sy + y, sxx + x * x, sxy + x * y, n + 1
    end
  end
  wanted.side = nil
  if n < 2 then return nil end
  return (n * sxy - sx * sy) / (n * sxx - sx * sx)
end

return results
