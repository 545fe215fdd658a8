--- Lottie animations as other players draw them, beside the same pixels by celspan.
local system = require "tests.support.system"

local players = {}

--- Whether Skottie and ThorVG are in a folder of modules for Node.
function players.are_in(modules)
  return system.read(modules .. "/canvaskit-wasm/package.json")
    and system.read(modules .. "/@thorvg/webcanvas/package.json") and true
end

--- The command of Skottie or ThorVG, before the arguments that follow.
function players.command(modules, player)
  return { "node", "tests/support/lottie_players.js", modules, player }
end

--- Draws frames, counted from 0, of a file over white. command: a list of words. Returns the
--- pixels of each as rows of RGBA; nil if the player fails.
function players.draw(command, file, out, size, frames)
  local words = { table.unpack(command) }
  for _, word in ipairs { file, out, size[1], size[2], table.unpack(frames) } do
    words[#words + 1] = word
  end
  for i, word in ipairs(words) do words[i] = system.quote(word) end
  if not os.execute(table.concat(words, " ") .. " 2>/dev/null") then return nil end
  local list = {}
  for i, frame in ipairs(frames) do
    local path = ("%s.%d"):format(out, frame)
    list[i] = assert(system.read(path))
    os.remove(path)
  end
  return list
end

local function over_white(code, alpha) return (255 * (255 - alpha) + code * alpha) / 255 end

--- How many of the pixels of two rows of RGBA, laid over white, differ by at most `codes`, with
--- is_clear also in how opaque they are.
local function count_alike(own, other, codes, is_clear)
  local good = 0
  for i = 1, #own, 4 do
    local r, g, b, a = own:byte(i, i + 3)
    local r2, g2, b2, a2 = other:byte(i, i + 3)
    if a < 255 then r, g, b = over_white(r, a), over_white(g, a), over_white(b, a) end
    if a2 < 255 then r2, g2, b2 = over_white(r2, a2), over_white(g2, a2), over_white(b2, a2) end
    local alpha = is_clear and math.abs(a - a2) or 0
    if math.max(math.abs(r - r2), math.abs(g - g2), math.abs(b - b2), alpha) <= codes then
      good = good + 1
    end
  end
  return good
end

local PIECE = 256 -- bytes of both that are compared at once

--- The share of pixels that differ by at most `codes` in each channel, both laid over white.
--- is_clear: and in alpha, which not all players write.
function players.share(own, other, codes, is_clear)
  assert(#own == #other, "the pictures have different sizes")
  local good = 0
  for i = 1, #own, PIECE do
    local a, b = own:sub(i, i + PIECE - 1), other:sub(i, i + PIECE - 1)
    good = good + (a == b and #a // 4 or count_alike(a, b, codes, is_clear))
  end
  return good / (#own // 4)
end

return players
