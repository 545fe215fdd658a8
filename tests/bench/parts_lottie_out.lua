--- Films as Lottie animations: their sizes beside a video of the same frames, and how much of them
--- other players show as celspan draws it.
local Command = require("tests.bench.runner").command
local players = require "tests.support.players"
local present = require "tests.support.present"
local system = require "tests.support.system"

local parts = {}

local SHOWN = 20   -- frames of each film that are compared, spread over it
local CODES = 8    -- how far a pixel may be in each channel
local LEAST = 0.97 -- the share of pixels that a player has to show so, in the worst frame

--- Scripts, and a part of the frames where the whole film would take minutes.
local films = {
  { "title" }, { "credits" }, { "exposure_sheet" }, { "lip_cels" }, { "turn" }, { "waving" },
  { "pan", "1-20" }, { "parallax", "1-20" }, { "rack_focus", "1-20" }, { "walking", "1-20" },
  { "film", "250-269" }, { "demo", "100-119" },
}

--- Renders frames of a film. Returns what was written to standard output; nil: it failed.
local function render(runner, film, frames, out)
  local words = { runner.celspan, "render", "scripts/" .. film[1] .. ".lua", "--trust",
    "--progress", "none", "-o", out }
  if frames then words[#words + 1], words[#words + 2] = "--frames", frames end
  local pipe = assert(io.popen("CELSPAN_PATH='scripts/?.lua' " .. Command(table.unpack(words))
    .. " 2>/dev/null"))
  local text = pipe:read "a"
  return pipe:close() and text or nil
end

--- The frames that are compared, counted from 0.
local function spread(count)
  local list, shown = {}, math.min(SHOWN, count)
  for i = 0, shown - 1 do list[i + 1] = i * count // shown end
  return list
end

--- celspan's pixels of these frames, as rows of RGBA.
local function own_pixels(runner, film, frames, size)
  local first, names, list = tonumber((film[2] or "1"):match "^%d+"), {}, {}
  for i, frame in ipairs(frames) do names[i] = first + frame end
  local bytes = assert(render(runner, film, table.concat(names, ","), "-"))
  local each = 4 * size[1] * size[2]
  for i = 1, #frames do list[i] = bytes:sub((i - 1) * each + 1, i * each) end
  return list
end

--- The commands of the players that are here, by their names.
local function commands(runner)
  local list = {}
  for _, player in ipairs(runner.modules and { "skottie", "thorvg" } or {}) do
    list[#list + 1] = { player, players.command(runner.modules, player) }
  end
  if runner:has "rlottie" then
    list[#list + 1] = { "rlottie", { runner:program "rlottie", "show" } }
  end
  return list
end

--- The smallest share of pixels of a frame that is alike.
local function worst(own, other)
  local least = 1
  for i, pixels in ipairs(own) do
    least = math.min(least, players.share(pixels, other[i], CODES))
  end
  return least
end

local function kilobytes(path) return #assert(system.read(path)) / 1000 end

--- The size and the count of frames of a file, without reading all of it as JSON.
local function facts_of(path)
  local text = assert(system.read(path))
  local count, width = text:sub(-100):match '"op":(%d+),"v":[^,]*,"w":(%d+)}$'
  return { tonumber(width), tonumber(text:match '"fr":[%d.]+,"h":(%d+)') }, tonumber(count)
end

--- The cells of a film's line: sizes, and a share for each player.
local function measure(runner, film, place)
  local out = place .. "/" .. film[1]
  for _, ending in ipairs { ".json", ".lottie", ".mp4" } do
    if not render(runner, film, film[2], out .. ending) then return nil end
  end
  local size, count = facts_of(out .. ".json")
  local frames = spread(count)
  local own, good = own_pixels(runner, film, frames, size), 0
  local cells = { ("   %-16s %6d %9.0f %9.0f %9.0f"):format(film[1], count,
    kilobytes(out .. ".json"), kilobytes(out .. ".lottie"), kilobytes(out .. ".mp4")) }
  for _, player in ipairs(commands(runner)) do
    local other = players.draw(player[2], out .. ".json", out, size, frames)
    local share = other and worst(own, other)
    cells[#cells + 1] = share and ("%8.2f"):format(100 * share) or "   fails"
    if share and share >= LEAST then good = good + 1 end
  end
  return table.concat(cells, " "), good >= 2
end

function parts.lottie_out(runner, folder, is_quick)
  if not present.program "ffmpeg" then return runner:note "lottie_out: ffmpeg is missing" end
  local place, passed, count = runner.root .. "/" .. folder .. "/lottie_out", 0, 0
  assert(os.execute(Command("mkdir", "-p", place)))
  print(("   %-16s %6s %9s %9s %9s"):format("film", "frames", "json kB", "lottie kB", "mp4 kB")
    .. "  and the % of pixels in the worst frame by each player")
  for i, film in ipairs(films) do
    if i > 3 and is_quick then break end
    local line, is_good = measure(runner, film, place)
    print(line or ("   %-16s could not be rendered"):format(film[1]))
    passed, count = passed + (is_good and 1 or 0), count + (line and 1 or 0)
  end
  if #commands(runner) < 2 then
    print "   two players are needed to say more: Skottie and ThorVG, or --skia, or rlottie"
  else
    print(("   %d of %d films have %g %% within %d codes in two players"):format(passed, count,
      100 * LEAST, CODES))
  end
  os.execute(Command("rm", "-r", place))
end

return parts
