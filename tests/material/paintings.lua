--- The result for every Photoshop document of the sample material, each read by a process of its
--- own.
--
--   lua5.4 tests/material/paintings.lua MATERIAL     with LUA_PATH and LUA_CPATH as for specs
--
-- A line per file: name; read, or refused and the reason; milliseconds of reading it and rendering
-- all of its layers; peak memory of the process, in MiB; the share of the pixels that differ from
-- the picture merged by the program that made the file, by more than 8 of 255 over white, blended
-- as coded; and the notes about blend modes, effects and others. The last line counts them.
local celspan = require "celspan"
local native = require "tests.support.own" "celspan.native"
local layers = require "celspan.layers"
local merged = require "tests.support.merged"

local function peak_mebibytes()
  for line in io.lines "/proc/self/status" do
    local kibibytes = line:match "^VmHWM:%s*(%d+)"
    if kibibytes then return kibibytes / 1024 end
  end
end

--- The layers over white, blended as coded: their codes are used as linear light.
local function mixed_as_coded(path)
  local painting = assert(native.painting(path))
  local inside, all = {}, {}
  for i, layer in ipairs(painting.layers) do -- a group comes after its layers
    local object = layer.pixels and celspan.image { pixels = layer.pixels, colour = "linear",
      x = layer.x, y = layer.y, w = layer.width, h = layer.height,
      as = layer.blend == "multiply" and "gel" or nil } or celspan.union(inside[i] or {})
    local siblings = layer.parent and (inside[layer.parent] or {}) or all
    if layer.parent then inside[layer.parent] = siblings end
    if layer.visible then siblings[#siblings + 1] = object:fade(layer.opacity) end
  end
  local cels = {}
  for i, object in ipairs(all) do cels[i] = celspan.cel { object } end
  cels.back = "#fff"
  return assert(celspan.pixels(celspan.rostrum(cels),
    { size = { painting.width, painting.height } }))
end

--- The share of the pixels that differ; nil if the merged picture does not have 8 bits.
local function share_off(path)
  local good, theirs = pcall(merged.read, path)
  if not good then return nil end
  local ours = mixed_as_coded(path):bytes { depth = 8, colour = "linear", alpha = "straight" }
  local off = 0
  for k = 0, theirs.width * theirs.height - 1 do
    local most = 0
    for c = 1, 3 do
      most = math.max(most, math.abs(ours:byte(4 * k + c) - (theirs[c] or theirs[1])[k]))
    end
    if most > 8 then off = off + 1 end
  end
  return off / (theirs.width * theirs.height)
end

local function describe(path)
  local began = os.clock()
  local tree, message = layers.read(path)
  if tree then
    local cels = tree:cels()
    cels.back = "#fff"
    assert(celspan.pixels(celspan.rostrum(cels), { size = { tree.width, tree.height } }))
  end
  local spent, peak = 1000 * (os.clock() - began), peak_mebibytes()
  local facts = ("%6.1f ms %5.1f MiB"):format(spent, peak)
  if not tree then return ("refused %s  %s"):format(facts, message:gsub("^.-: ", "")) end
  local share, told, seen = share_off(path), {}, {}
  for _, note in ipairs(tree.skipped) do
    if not seen[note.what] then told[#told + 1] = note.what end
    seen[note.what] = true
  end
  return ("read    %s  %s %s"):format(facts, share and ("%5.1f %% off"):format(100 * share) or
    "not compared", table.concat(told, "; "))
end

if arg[2] then
  print(describe(arg[2]))
  return
end

--- The interpreter that runs this.
local function interpreter()
  local file = assert(io.open("/proc/self/cmdline", "rb"))
  local line = file:read "a"
  file:close()
  return line:match "^[^%z]+"
end

local program = interpreter()
local counts = { read = 0, refused = 0 }
local find =
  assert(io.popen(("cd '%s/psd' && find . -name '*.psd' | LC_ALL=C sort"):format(arg[1])))
for line in find:lines() do
  local one = assert(io.popen(("'%s' '%s' '%s' '%s/psd/%s'"):format(program, arg[0], arg[1], arg[1],
    line)))
  local text = one:read "l"
  one:close()
  print(("%-36s %s"):format(line:sub(3), text))
  local kind = text:match "^%a+"
  counts[kind] = counts[kind] + 1
end
find:close()
print(("%d read, %d refused"):format(counts.read, counts.refused))
