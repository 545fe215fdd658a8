--- Films on both sides of each limit of WCAG 2.3.1. As a program, it prints beside the answers by
--- WCAG what ffmpeg's filter "photosensitivity" says of the same films:
---
---   lua5.4 tests/support/flashes.lua
local flashes = {}

--- The light at a frame of a film that changes `count` times between two lights, every `hold`
--- frames; each change takes `steps` frames.
local LIGHT = [[
local function light_at(index, low, high, hold, count, steps)
  local change = math.min(count, index // hold)
  local share = change < count and math.min(1, (index % hold + 1) / steps) or 1
  local from, to = low, high
  if change % 2 == 0 then from, to = high, low end
  if change == 0 then from = to end
  return from + (to - from) * share
end
]]

--- The script of such a film: `cells` of its 100 pixels change.
flashes.FILM = LIGHT .. [[
local celspan = require "celspan"
local fps, low, high, hold, cells, count, steps = ...
fps, hold, cells = tonumber(fps), tonumber(hold), tonumber(cells)
count, steps = tonumber(count), tonumber(steps)
return celspan.film { size = { 10, 10 }, fps = fps, frames = 200, frame = function(f)
  local light = light_at(f.index, low, high, hold, count, steps)
  local paint = celspan.rgb(light, light, light)
  return celspan.rostrum { back = "#000", celspan.cel {
    celspan.rect { 0, 0, 10, cells // 10, texture = paint },
    celspan.rect { 0, cells // 10, cells % 10, 1, texture = paint } } }
end }]]

--- By WCAG: fps, the darker and the brighter light, frames between changes, cells, changes,
--- steps of a change, and whether this is more than three flashes in a second.
flashes.MADE = {
  -- the change of the relative luminance
  { 24, 0.2, 0.3, 3, 100, 20, 1, true }, { 24, 0.2, 0.29, 3, 100, 20, 1, false },
  { 24, 0, 0.1, 3, 100, 20, 1, true }, { 24, 0, 0.099, 3, 100, 20, 1, false },
  { 24, 0.5, 0.601, 3, 100, 20, 1, true }, { 24, 0.5, 0.599, 3, 100, 20, 1, false },
  { 24, 0, 1, 3, 100, 20, 1, true }, { 24, 0.4, 0.4, 3, 100, 20, 1, false },
  -- the darker light
  { 24, 0.7, 0.8, 3, 100, 20, 1, true }, { 24, 0.8, 0.9, 3, 100, 20, 1, false },
  { 24, 0.79, 0.89, 3, 100, 20, 1, true }, { 24, 0.79, 0.88, 3, 100, 20, 1, false },
  { 24, 0.799, 0.9, 3, 100, 20, 1, true }, { 24, 0.801, 1, 3, 100, 20, 1, false },
  { 24, 0.7, 1, 3, 100, 20, 1, true }, { 24, 0.85, 1, 3, 100, 20, 1, false },
  -- how many: four flashes are eight changes
  { 24, 0.2, 0.8, 3, 100, 8, 1, true }, { 24, 0.2, 0.8, 3, 100, 7, 1, false },
  { 24, 0.2, 0.8, 3, 100, 9, 1, true }, { 24, 0.2, 0.8, 3, 100, 6, 1, false },
  { 24, 0.2, 0.8, 1, 100, 8, 1, true }, { 24, 0.2, 0.8, 1, 100, 7, 1, false },
  -- how fast: eight changes in less than a second
  { 24, 0.2, 0.8, 3, 100, 20, 1, true }, { 24, 0.2, 0.8, 4, 100, 20, 1, false },
  { 30, 0.2, 0.8, 4, 100, 20, 1, true }, { 30, 0.2, 0.8, 5, 100, 20, 1, false },
  { 60, 0.2, 0.8, 8, 100, 20, 1, true }, { 60, 0.2, 0.8, 9, 100, 20, 1, false },
  { 50, 0.2, 0.8, 7, 100, 20, 1, true }, { 50, 0.2, 0.8, 8, 100, 20, 1, false },
  { 12, 0.2, 0.8, 1, 100, 20, 1, true }, { 12, 0.2, 0.8, 2, 100, 20, 1, false },
  { 29, 0.2, 0.8, 4, 100, 20, 1, true }, { 28, 0.2, 0.8, 4, 100, 20, 1, false },
  { 8, 0.2, 0.8, 1, 100, 20, 1, true }, { 7, 0.2, 0.8, 1, 100, 20, 1, false },
  -- where
  { 24, 0.2, 0.8, 3, 26, 20, 1, true }, { 24, 0.2, 0.8, 3, 25, 20, 1, false },
  { 24, 0.2, 0.8, 3, 50, 20, 1, true }, { 24, 0.2, 0.8, 3, 10, 20, 1, false },
  -- slow changes count from the last extreme
  { 60, 0.2, 0.4, 8, 100, 20, 8, true }, { 60, 0.2, 0.29, 8, 100, 20, 8, false },
}

-- ---------------------------------------------------------------- beside ffmpeg

local light_at = load(LIGHT .. "return light_at")()
local FRAMES, SIDE = 100, 10 -- frames looked at, and pixels a cell has along a side for ffmpeg

--- The 8-bit code of a light, by IEC 61966-2-1.
local function code_of(light)
  local code = light <= 0.0031308 and 12.92 * light or 1.055 * light ^ (1 / 2.4) - 0.055
  return string.char(math.floor(255 * code + 0.5))
end

--- Frame `index` of a film as bytes of grey.
local function picture(one, index)
  local _, low, high, hold, cells, count, steps = table.unpack(one)
  local lit, dark = code_of(light_at(index, low, high, hold, count, steps)), "\0"
  local rows = {}
  for row = 0, 9 do
    local width = math.max(0, math.min(10, cells - 10 * row))
    rows[#rows + 1] = (lit:rep(width * SIDE) .. dark:rep((10 - width) * SIDE)):rep(SIDE)
  end
  return table.concat(rows)
end

--- Whether ffmpeg's filter would dim a frame: its factor is below 1.
local function is_dimmed(one)
  local said = os.tmpname()
  local encoder = assert(io.popen(("ffmpeg -loglevel error -f rawvideo -pix_fmt gray -s 100x100 "
    .. "-r %d -i - -vf format=rgb24,photosensitivity=f=%d,metadata=print:file=%s "
    .. "-f null -"):format(one[1], one[1], said), "w"))
  for index = 0, FRAMES - 1 do encoder:write(picture(one, index)) end
  assert(encoder:close())
  local least = 1
  for line in io.lines(said) do
    least = math.min(least, tonumber(line:match "photosensitivity%.factor=(%g+)") or 1)
  end
  os.remove(said)
  return least < 1
end

local function main()
  local same, more = 0, 0
  print "fps darker brighter hold cells changes steps: more than three flashes by WCAG, by ffmpeg"
  for _, one in ipairs(flashes.MADE) do
    local dimmed = is_dimmed(one)
    if dimmed == one[8] then same = same + 1 elseif dimmed then more = more + 1 end
    print(table.concat(one, " ", 1, 7) .. ": " .. tostring(one[8]) .. ", " .. tostring(dimmed))
  end
  print(("of %d films ffmpeg agrees with WCAG on %d and dims %d that WCAG allows"):format(
    #flashes.MADE, same, more))
end

if not ... then main() end

return flashes
