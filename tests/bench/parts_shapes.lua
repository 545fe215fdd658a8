--- The shapes: celspan and the peers on the same drawings, at every side, and the limits.
local scenes = require "tests.bench.scenes"

local Command = require("tests.bench.runner").command
local parts = {}

--- Rows of a band, the fastest or nearly the fastest for every peer; and the share of the bands
--- that represents all of them where a frame takes seconds.
local function band_of(side) return side <= 4096 and 256 or 64 end

--- Sides in pixels: those of films, and one of a poster.
local sides, film_sides = { 1024, 2048, 4096, 30000 }, { 1024, 2048, 4096 }

local strides = { ["10"] = 1, ["100"] = 4, small = 4 }
local function stride_of(scene, side) return side < 30000 and 1 or strides[scene] or 16 end

local function celspan(runner, path, scene, side, antialias, output, workers)
  return { command = Command(runner:program "celspan", "shapes", path, side, antialias, output,
             workers), part = "shapes", scene = scene, side = side, output = output,
           antialias = antialias, renderer = "celspan", workers = workers }
end

local function peer(runner, path, scene, side, antialias, name, is_whole)
  local band = is_whole and 0 or band_of(side)
  local stride = is_whole and 1 or stride_of(scene, side)
  local program = name == "skia" and runner.skia or Command(runner:program(name))
  return { command = program .. " " .. Command("shapes", path, side, antialias, band, stride),
           part = "shapes", scene = scene, side = side, output = is_whole and "whole" or "row",
           antialias = antialias, renderer = name, workers = 1, is_part = stride > 1 and 1 or nil }
end

local function limit(runner, path, scene, side, line, name)
  return { command = Command(runner:program "limits", path, side), part = "shapes", scene = scene,
           side = side, output = "row", renderer = name, workers = 1,
           take = function(lines) return lines[line] end }
end

--- The peers that are installed; reports the missing ones.
function parts.peers(runner)
  local list = {}
  for _, name in ipairs { "agg", "cairo", "qt" } do
    if runner:has(name) then list[#list + 1] = name
    else runner:note(name .. " is not installed: it is left out") end
  end
  if runner:has "blend2d" then list[#list + 1] = "blend2d"
  else runner:note "Blend2D is not installed (BLEND2D_ROOT): it is left out" end
  if runner.skia then list[#list + 1] = "skia"
  else runner:note "skia is not installed (npm: @napi-rs/canvas): it is left out" end
  return list
end

--- All renderers of a drawing at one side.
local function renderers(runner, path, scene, side)
  local entries = {}
  for _, output in ipairs { "spans", "row" } do
    for _, antialias in ipairs { "none", "area" } do
      entries[#entries + 1] = celspan(runner, path, scene, side, antialias, output, 1)
    end
  end
  for _, name in ipairs(parts.peers(runner)) do
    entries[#entries + 1] = peer(runner, path, scene, side, "area", name)
  end
  if side <= 4096 then
    for _, way in ipairs { "swept", "again", "first" } do
      entries[#entries + 1] = celspan(runner, path, scene, side, way, "row", 1)
    end
  end
  return entries
end

--- A drawing by two ways, in turn.
local function compare(runner, folder, scene, way, other, output)
  local path = ("%s/%s.txt"):format(folder, scene)
  runner:measure(2, { celspan(runner, path, scene, 1024, way, output, 1),
                      celspan(runner, path, scene, 1024, other, output, 1) })
end

--- One drawing at one side: all its renderers, in turn, and the limits.
local function point(runner, folder, scene, side, rounds)
  local path = ("%s/%s.txt"):format(folder, scene)
  local entries = renderers(runner, path, scene, side)
  entries[#entries + 1] = limit(runner, path, scene, side, 1, "memset")
  entries[#entries + 1] = limit(runner, path, scene, side, 2, "fill of runs")
  runner:measure(rounds, entries)
end

function parts.shapes(runner, folder, is_quick)
  for _, scene in ipairs(is_quick and { "100" } or scenes.random) do
    for _, side in ipairs(is_quick and film_sides or sides) do
      point(runner, folder, scene, side, side < 30000 and 3 or 2)
    end
  end
end

function parts.hard(runner, folder, is_quick)
  for _, scene in ipairs(scenes.hard) do
    for _, side in ipairs(is_quick and { 1024 } or sides) do
      point(runner, folder, scene, side, side < 30000 and 2 or 1)
    end
  end
  -- It has no map: what remains is what it costs to find that out, and to remember it.
  compare(runner, folder, "faint", "mapped", "mapped-again", "row")
end

--- A gradient has no runs of one colour, so the limits say nothing here.
function parts.gradients(runner, folder, is_quick)
  for _, scene in ipairs(is_quick and { "gradients-100" } or scenes.gradients) do
    for _, side in ipairs(is_quick and { 1024 } or film_sides) do
      local path = ("%s/%s.txt"):format(folder, scene)
      local entries = renderers(runner, path, scene, side)
      for _, entry in ipairs(entries) do entry.limit = 10 end
      runner:measure(1, entries)
    end
  end
end

function parts.artwork(runner, folder, is_quick)
  if not runner.has_material then
    return runner:note "no CELSPAN_MATERIAL: the random shapes are made, artwork is left out"
  end
  for _, scene in ipairs(scenes.artwork) do
    for _, side in ipairs(is_quick and { 1024, 4096 } or sides) do
      point(runner, folder, scene, side, side < 30000 and 2 or 1)
    end
    compare(runner, folder, scene, "area", "swept", "strip")
  end
end

--- Sides that no renderer of pixels reaches.
function parts.large(runner, folder, is_quick)
  for _, scene in ipairs(is_quick and { "100" } or scenes.random) do
    local path = ("%s/%s.txt"):format(folder, scene)
    for _, side in ipairs { 100000, 1000000 } do
      local entries = {}
      for _, antialias in ipairs { "none", "area" } do
        entries[#entries + 1] = celspan(runner, path, scene, side, antialias, "spans", 1)
      end
      runner:measure(is_quick and 1 or 2, entries)
    end
  end
end

--- Whole images in memory, without antialiasing too.
function parts.whole(runner, folder, is_quick)
  for _, scene in ipairs(is_quick and {} or { "100", "1000" }) do
    local path = ("%s/%s.txt"):format(folder, scene)
    local entries = { celspan(runner, path, scene, 4096, "area", "whole", 1) }
    for _, name in ipairs(parts.peers(runner)) do
      entries[#entries + 1] = peer(runner, path, scene, 4096, "area", name, true)
    end
    runner:measure(2, entries)
    entries = {}
    for _, name in ipairs { "agg", "cairo", "qt" } do
      if runner:has(name) then
        entries[#entries + 1] = peer(runner, path, scene, 4096, "none", name)
      end
    end
    runner:measure(2, entries)
  end
end

--- One worker and two.
function parts.workers(runner, folder, is_quick)
  for _, scene in ipairs(is_quick and { "100" } or { "100", "1000" }) do
    for _, side in ipairs(is_quick and { 4096 } or { 4096, 30000 }) do
      local path = ("%s/%s.txt"):format(folder, scene)
      local entries = {}
      for workers = 1, 2 do
        entries[workers] = celspan(runner, path, scene, side, "area", "row", workers)
        entries[workers].part = "workers"
      end
      runner:measure(5, entries)
    end
  end
end

--- Whether the peers draw the same picture: the distance of their cells from celspan's, at 1024.
function parts.agreement(runner, folder, is_quick)
  local names = is_quick and { "100", "gradients-100" }
    or { "10", "100", "1000", "opaque", "small", "faint", "gradients-100", "gradients-1000" }
  if runner.has_material and not is_quick then
    table.move(scenes.artwork, 1, #scenes.artwork, #names + 1, names)
  end
  for _, scene in ipairs(names) do
    local path = ("%s/%s.txt"):format(folder, scene)
    local truth = assert(runner:ask(Command(runner:program "celspan", "look", path, 1024)))
    for _, name in ipairs(parts.peers(runner)) do
      local program = name == "skia" and runner.skia or Command(runner:program(name))
      local seen = runner:ask(program .. " " .. Command("look", path, 1024))
      if seen then
        local rms = runner.distance(truth[1].picture, seen[1].picture)
        runner.rows[#runner.rows + 1] = { part = "agreement", scene = scene, side = 1024,
          output = "whole", antialias = "area", renderer = name, rms = rms }
        print(("   %-9s %-6s differs by %.2f of 255"):format(scene, name, rms))
      end
    end
  end
end

return parts
