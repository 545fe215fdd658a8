-- Rolling credits: two columns that meet in the middle, one right-aligned and one left-aligned,
-- roll up the frame and fade at its edges. The text is made once; each frame only moves it.

local FPS = 24
local WIDTH, HEIGHT = 960, 540
local SIZE, LEADING = 32, 1.6
local FONT = "type/block.ttf"

local credits = {
  { "written by", "Ada Quill" }, { "drawn by", "Bruno Nib\nCleo Pastel" },
  { "inked by", "Dora Blot" }, { "painted by", "Emil Gouache\nFay Ochre\nGus Umber" },
  { "backgrounds", "Hana Wash" }, { "photographed by", "Ivo Rostrum" },
  { "music", "Juno Reed\nKarl Brass" }, { "thanks to", "all who lent us\ntheir pencils" },
}

--- One column: the text, and its number of lines.
local function column(text, x, align, texture)
  return celspan.text { text, x, 0, font = FONT, size = SIZE, leading = LEADING,
    align = align, fill = texture, variations = { wght = align == "left" and 600 or 400 } }
end

local roles, names = {}, {}
for i, credit in ipairs(credits) do
  local _, breaks = credit[2]:gsub("\n", "")
  names[i] = credit[2] .. "\n"
  roles[i] = credit[1] .. ("\n"):rep(breaks + 1)
end
local roll = column(table.concat(roles, "\n"), WIDTH / 2 - 20, "right", "#8fa3b8")
  | column(table.concat(names, "\n"), WIDTH / 2 + 20, "left", "#f6ead2")
local _, top, _, height = roll:bounds()

--- Darkness that hides the ends of the roll, from the edge of the frame inwards. Light is mixed,
--- and text is still readable at a tenth of it, so most of the fading is near the edge.
local dark = "#10151c"
local function shade(from, to)
  return rect { 0, math.min(from, to), WIDTH, math.abs(to - from),
    fill = linear { from = { 0, from }, to = { 0, to }, { 0, dark },
      { 0.25, dark .. "fa" }, { 0.55, dark .. "b0" }, { 1, dark .. "00" } } }
end
local shades = cel { shade(0, 120), shade(HEIGHT, HEIGHT - 120) }
local ground = cel { rect { 0, 0, WIDTH, HEIGHT, fill = radial {
  centre = { WIDTH / 2, HEIGHT / 2 }, radius = WIDTH / 2, { 0, "#1d2936" }, { 1, dark } } } }

return film { title = "Rolling credits", size = { WIDTH, HEIGHT }, fps = FPS,
  frames = 10 * FPS,
  frame = function(f)
    local from, to = HEIGHT - top, -top - height
    local rolled = roll:translate(0, from + (to - from) * f.progress)
    return { ground, rolled, shades }
  end }
