-- Puts back pictures that were made again and show the same, so that only what changed is stored:
--
--   lua5.4 docs/pictures/keep.lua BINARY FOLDER [NOW]
--
-- FOLDER has them as they were, and NOW, which is docs/pictures, as they are.
package.path = "./?.lua;" .. package.path
local system = require "tests.support.system"

local binary, folder, now = ...
assert(binary and folder, "usage: lua5.4 docs/pictures/keep.lua BINARY FOLDER [NOW]")
now = now or "docs/pictures"

local MOST_OFF = 2 -- codes, of a film that was only coded again

local function looks_same(before, after)
  if before:find "%.png$" then
    return os.execute(("'%s' compare '%s' '%s' --fail 0.02 >/dev/null")
      :format(binary, before, after))
  end
  local off = system.output(("/usr/bin/python3 docs/pictures/off.py '%s' '%s' 24")
    :format(before, after))
  return tonumber(off:match "^%d+" or 255) <= MOST_OFF
end

local names = system.output(("cd '%s' && find * -type f | LC_ALL=C sort"):format(folder))
for name in names:gmatch "[^\n]+" do
  local before, after = folder .. "/" .. name, now .. "/" .. name
  local is_picture = name:find "%.png$" or name:find "%.webp$" or name:find "%.mp4$"
  if is_picture and system.exists(after) and system.read(before) ~= system.read(after) then
    if looks_same(before, after) then
      assert(os.execute(("cp '%s' '%s'"):format(before, after)))
    else
      print("changed: " .. name)
    end
  end
end
