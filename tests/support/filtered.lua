--- Drawings of SVG filters of 120 x 100 pixels, in codes: by celspan and by Chromium.
local celspan = require "celspan"
local browsing = require "tests.support.browsing"
local json = require "celspan.json"
local svg = require "celspan.svg"
local system = require "tests.support.system"

local filtered = { width = 120, height = 100 }

--- The picture of objects.
function filtered.image(objects, width, height)
  return assert(celspan.pixels(celspan.film { space = "srgb",
    size = { width or filtered.width, height or filtered.height },
    frame = function() return celspan.rostrum { celspan.cel(objects) } end }))
end

function filtered.read(text)
  local path = os.tmpname()
  system.write(path, text)
  local art, message = svg.read(path)
  os.remove(path)
  return assert(art, message)
end

--- The picture of a drawing, and what is left out of it first, or "".
function filtered.draw(text)
  local art = filtered.read(text)
  return filtered.image { art.object }, art.skipped[1] and art.skipped[1].what or ""
end

--- The picture of the browser's window with one drawing or several.
function filtered.in_browser(text, width, height)
  local path = os.tmpname()
  local script = "document.body.style.margin = 0; document.body.innerHTML = "
    .. json.encode((text:gsub("<svg ", '<svg style="display:block" ')))
  browsing.see("about:blank", ("await page.get(%s); await page.shot(%s); return true;"):format(
    json.encode(script), json.encode(path)))
  local image = filtered.image({ celspan.image { file = path, x = 0, y = 0 } }, width, height)
  os.remove(path)
  return image
end

--- The share of the pixels of a picture that differ by at most 8 codes from those of another one,
--- in which they lie at (left, top).
function filtered.share_near(one, other, left, top)
  local a, b, near = one:bytes(), other:bytes(), 0
  for y = 0, one.height - 1 do
    for x = 0, one.width - 1 do
      local i = 4 * (one.width * y + x)
      local k, worst = 4 * (other.width * (y + (top or 0)) + x + (left or 0)), 0
      for c = 1, 3 do worst = math.max(worst, math.abs(a:byte(i + c) - b:byte(k + c))) end
      if worst <= 8 then near = near + 1 end
    end
  end
  return near / one.width / one.height
end

return filtered
