--- Rates of films, and the codes that edit lists count frames with: hours:minutes:seconds:frames.
--
--   frame 1799    00:00:59;29
--   frame 1800    00:01:00;02      drop frames: two codes are left out in each minute but the
--                                  tenth, so that codes at 30000/1001 go with the clock
local timecode = {}

local DAY = 24 * 60 * 60 -- seconds: no code is later
local SLOWED = 20 -- from this rate on, a rate a little below a whole number is slowed by 1001/1000
local NEAR = 0.0045 -- 23.98 is 24000/1001

--- The rate that a number means: 29.97 is 30000/1001. Second, the codes of a second; nil: a second
--- at this rate has no whole number of codes.
---@param fps number
---@return number rate
---@return integer? codes
function timecode.rate(fps)
  local codes = math.floor(fps + 0.5)
  if math.abs(fps - codes) < 1e-9 and codes > 0 then return codes, codes end
  local slow = codes * 1000 / 1001
  if codes >= SLOWED and math.abs(fps - slow) < NEAR then return slow, codes end
  return fps
end

--- How many codes are left out in a minute with drop frames; nil: the rate has none.
function timecode.dropped(fps)
  local rate, codes = timecode.rate(fps)
  if codes and rate ~= codes and codes % 30 == 0 then return codes // 15 end
end

--- The frame of a code, from 0; nil and a message. dropped: the codes left out in a minute, or 0.
---@return integer? frame
---@return string? message
function timecode.frame(text, codes, dropped)
  local hours, minutes, seconds, frames = text:match "^(%d%d):(%d%d):(%d%d)[:;.,](%d%d%d?)$"
  if not hours then return nil, ("%q is no code such as 01:00:02:12"):format(text) end
  local minute = math.tointeger(hours) * 60 + minutes
  local frame, second = math.tointeger(frames), math.tointeger(seconds)
  if frame >= codes or second > 59 or tonumber(minutes) > 59 or minute * 60 >= DAY then
    return nil, ("%s does not exist at %d codes a second"):format(text, codes)
  end
  if second == 0 and frame < dropped and minute % 10 > 0 then
    return nil, ("%s does not exist with drop frames"):format(text)
  end
  return math.tointeger((minute * 60 + second) * codes + frame
    - dropped * (minute - minute // 10))
end

--- The code of a frame, from 0; nil if it is a day or later.
---@return string? code
function timecode.text(frame, codes, dropped)
  local ten, first = codes * 600 - 9 * dropped, codes * 60
  local rest = frame % ten
  local minutes = rest < first and 0 or 1 + (rest - first) // (first - dropped)
  local code = frame + dropped * (frame // ten * 9 + minutes)
  local seconds = code // codes
  if seconds >= DAY then return nil end
  return ("%02d:%02d:%02d%s%02d"):format(seconds // 3600, seconds // 60 % 60, seconds % 60,
    dropped > 0 and ";" or ":", code % codes)
end

return require "celspan.fields".seal("timecode", timecode)
