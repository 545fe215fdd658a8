-- The animator in five lines of blue pencil; on her sheet lies the town in full colour.
local pencil, sheet = require "town.pencil", require "town.sheet"
local studio, window = require "town.studio", require "town.window"

local BLUE = "#5f93c4"
local town = sheet.town():translate(studio.left, studio.top)

--- Sheet, bun and head, back and near arm, far arm, pencil.
local five = { { 42, 506, 41, 400, 43, 277, 43, 277, 225, 275, 408, 277, 408, 277, 409, 400, 407,
  506, 407, 506, 230, 509, 60, 507 },
  { 122, 176, 92, 160, 98, 130, 128, 128, 138, 150, 176, 128, 208, 152, 214, 190, 228, 210, 214,
    216, 208, 236, 176, 244, 130, 236, 106, 206, 104, 172, 134, 140 },
  { 126, 240, 60, 262, 24, 300, 14, 380, 20, 470, 52, 524, 110, 526, 138, 514 },
  { 178, 244, 240, 258, 310, 252, 362, 224, 388, 232, 392, 256, 396, 280, 384, 292, 370, 288, 364,
    274, 376, 262 },
  { 342, 290, 376, 272, 412, 250 } }

return window.film { title = "The animator, in blue", by = "pw", seconds = 4,
  drawing = function(_, number)
    local p = pencil.hand(number // 4 % 2 == 1)
    local shown = { rect { 0, 0, 450, 600, fill = pencil.light }, town }
    for i, places in ipairs(five) do
      shown[#shown + 1] = p.line(places, i == 1 and 3 or 6, BLUE)
    end
    return shown
  end }
