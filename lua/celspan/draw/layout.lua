--- Objects placed by their bounds, and texts letter by letter: celspan.row, column, grid, align,
--- fit, around and letters.
--
--   celspan.row{ icon, title, gap = 12, align = "centre" }     -- from 0, 0 to the right
--   celspan.align(title, { 0, 0, 1280, 720 }, "centre", "bottom")
--   celspan.letters({ "Hello", font = "sans.ttf" }, function(letter, i, n) ... end)
--
-- What has nothing to paint has no bounds: it takes no room, and no gap.
local celspan = require "celspan"
local native = require "celspan.native"
local curves = require "celspan.curves"
local fields = require "celspan.fields"

local layout = {}

local function refuse(text, ...) native.refuse(text:format(...)) end

--- The share of the free room that lies before an object.
local across = { left = 0, centre = 0.5, right = 1 }
local down = { top = 0, centre = 0.5, bottom = 1 }

--- The share that a word means. noun: the name of the function, for messages.
local function share_of(noun, field, word, shares, default)
  local share = shares[word == nil and default or word]
    or type(word) == "string" and shares[native.synonym(word)]
  if share then return share end
  local names = {}
  for name in pairs(shares) do names[#names + 1] = ("%q"):format(name) end
  table.sort(names)
  local hint = type(word) == "string" and native.nearest(word, { "left", "centre", "right", "top",
                                                               "bottom" })
  refuse("%s: %s must be %s, got %s%s", noun, field, table.concat(names, ", "),
    type(word) == "string" and ("%q"):format(word) or fields.kind(word),
    hint and shares[hint] and ("; did you mean %q?"):format(hint) or "")
end

--- The objects of a list that have bounds: { object =, x =, y =, w =, h = }. nil and false in the
--- list draw nothing.
local function read_items(noun, list)
  local items, last = {}, 0
  for key in next, list do
    if math.type(key) == "integer" and key > last then last = key end
  end
  for i = 1, last do
    local object = list[i]
    if object then
      local good, x, y, w, h = pcall(function() return object:bounds() end)
      fields.expect_kind(good, object, "%s: item %d must be an object", noun, i)
      if x then items[#items + 1] = { object = object, x = x, y = y, w = w, h = h } end
    end
  end
  return items
end

--- The object with its bounds at x, y.
local function moved(item, x, y) return item.object:translate(x - item.x, y - item.y) end

--- The object, moved so that its bounds are at these shares of the free room in a box.
local function placed(item, box, h, v)
  return moved(item, box[1] + (box[3] - item.w) * h, box[2] + (box[4] - item.h) * v)
end

--- The shares that the third and fourth arguments mean.
local function shares_of(noun, horizontal, vertical)
  return share_of(noun, "the third argument", horizontal, across, "centre"),
    share_of(noun, "the fourth argument", vertical, down, "centre")
end

local function check_gap(noun, gap)
  fields.expect(gap == nil or fields.is_finite(gap), gap,
    "%s: field 'gap' must be a finite number", noun)
  return gap or 0
end

local known = { "list", gap = "number", align = "string" }

--- Objects side by side by their bounds, from 0, 0 to the right. nil and false take no room.
---@param list { [integer]: celspan.shape, gap?: number, align?: "top"|"centre"|"bottom" }
---@return celspan.object
function layout.row(list)
  fields.check("row", list, known)
  local items, share = read_items("row", list), share_of("row", "align", list.align, down, "top")
  local gap, height, x, objects = check_gap("row", list.gap), 0, 0, {}
  for _, item in ipairs(items) do height = math.max(height, item.h) end
  for i, item in ipairs(items) do
    objects[i] = moved(item, x, (height - item.h) * share)
    x = x + item.w + gap
  end
  return celspan.union(objects)
end

--- Objects below one another, from 0, 0 down.
---@param list { [integer]: celspan.shape, gap?: number, align?: "left"|"centre"|"right" }
---@return celspan.object
function layout.column(list)
  fields.check("column", list, known)
  local items = read_items("column", list)
  local share = share_of("column", "align", list.align, across, "left")
  local gap, width, y, objects = check_gap("column", list.gap), 0, 0, {}
  for _, item in ipairs(items) do width = math.max(width, item.w) end
  for i, item in ipairs(items) do
    objects[i] = moved(item, (width - item.w) * share, y)
    y = y + item.h + gap
  end
  return celspan.union(objects)
end

--- Objects in rows of `columns`, each in the middle of its cell, from 0, 0.
---@param list { [integer]: celspan.shape, columns: integer, gap?: number }
---@return celspan.object
function layout.grid(list)
  fields.check("grid", list, { "list", columns = "number", gap = "number" })
  local gap = check_gap("grid", list.gap)
  local columns = fields.whole("grid: field 'columns'", list.columns, 1)
  local items, widths, heights = read_items("grid", list), {}, {}
  for i, item in ipairs(items) do
    local column, row = (i - 1) % columns + 1, (i - 1) // columns + 1
    widths[column] = math.max(widths[column] or 0, item.w)
    heights[row] = math.max(heights[row] or 0, item.h)
  end
  local objects, x, y = {}, 0, 0
  for i, item in ipairs(items) do
    local column, row = (i - 1) % columns + 1, (i - 1) // columns + 1
    if column == 1 and row > 1 then x, y = 0, y + heights[row - 1] + gap end
    objects[i] = moved(item, x + (widths[column] - item.w) / 2, y + (heights[row] - item.h) / 2)
    x = x + widths[column] + gap
  end
  return celspan.union(objects)
end

--- An object moved so that its bounds lie in a box, in the middle or at a side.
---@param object celspan.shape
---@param box number[] {x, y, w, h}
---@param horizontal? "left"|"centre"|"right" Default "centre"
---@param vertical? "top"|"centre"|"bottom" Default "centre"
---@return celspan.object
function layout.align(object, box, horizontal, vertical)
  fields.numbers("align", "box[%d]", box, 4, "{x, y, w, h}", 2)
  local h, v = shares_of("align", horizontal, vertical)
  local item = read_items("align", { object })[1]
  return item and placed(item, box, h, v) or object
end

--- Scales an object until its bounds just lie in a box, and aligns it there.
---@param object celspan.shape
---@param box number[] {x, y, w, h}
---@param horizontal? "left"|"centre"|"right" Default "centre"
---@param vertical? "top"|"centre"|"bottom" Default "centre"
---@param most? number The greatest factor; 1 only makes smaller. Default: none
---@return celspan.object
function layout.fit(object, box, horizontal, vertical, most)
  fields.numbers("fit", "box[%d]", box, 4, "{x, y, w, h}", 2)
  if box[3] <= 0 or box[4] <= 0 then
    refuse("fit: the box must have a width and a height above 0, got %s by %s",
      fields.shown(box[3]), fields.shown(box[4]))
  end
  fields.expect(most == nil or fields.is_finite(most) and most > 0, most,
    "fit: the fifth argument, the greatest factor, must be a number above 0")
  local h, v = shares_of("fit", horizontal, vertical)
  local item = read_items("fit", { object })[1]
  if not item then return object end
  local factor = math.min(item.w > 0 and box[3] / item.w or math.huge,
    item.h > 0 and box[4] / item.h or math.huge, most or math.huge)
  if factor == math.huge then factor = 1 end
  return placed(read_items("fit", { object:scale(factor) })[1], box, h, v)
end

--- The bounds of an object with a margin, as a box {x, y, w, h}.
---@param object celspan.shape
---@param margin? number|number[] On all sides, or {across, down}
---@return number[] box
function layout.around(object, margin)
  local item = read_items("around", { object })[1] or { x = 0, y = 0, w = 0, h = 0 }
  local pair = margin
  if type(margin) ~= "table" then pair = { margin or 0, margin or 0 } end
  fields.numbers("around", "margin[%d]", pair, 2, "a number or {across, down}", 2)
  return { item.x - pair[1], item.y - pair[2], item.w + 2 * pair[1], item.h + 2 * pair[2] }
end

-- ---------------------------------------------------------------- letters

local BLANK = "^[%s\u{a0}]*$"

--- The letters of a text in groups; each group has the fields of its first letter, its whole text
--- and its whole advance.
local function groups_of(letters, by)
  local groups, open = {}, nil
  for _, letter in ipairs(letters) do
    local is_blank = by == "word" and letter.text:find(BLANK) ~= nil
    local is_new = by == "letter" or not open or open.line ~= letter.line
      or open.is_blank ~= is_blank
    if is_new then
      open = native.as_letter { objects = {}, x = letter.x, y = letter.y, advance = 0, text = "",
                                line = letter.line, is_blank = is_blank }
      groups[#groups + 1] = open
    end
    table.insert(open.objects, letter.object)
    open.text, open.advance = open.text .. letter.text, open.advance + letter.advance
    open.middle = open.x + open.advance / 2
  end
  return groups
end

--- Puts a group on a curve: the middle of its advance is on the line, and y is its distance from
--- the line. left: the place of the text that lies at the start. Returns false if the group is
--- beyond the ends.
local function ride(group, curve, start, left)
  local middle = group.middle
  local length = start * curve.length + middle - left
  if curve.is_closed then length = length % curve.length end
  if length < 0 or length > curve.length then return false end
  local x, y, dx, dy = curve:at(length)
  local degrees = math.deg(math.atan(dy, dx))
  group.object = group.object:translate(-middle, 0):rotate(degrees):translate(x, y)
  group.x, group.y, group.middle, group.degrees = x, y, x, degrees
  return true
end

--- Where a text begins on an open path, ends there, or has its middle, by its alignment.
local starts = { centre = 0.5, center = 0.5, right = 1 }

local function as_it_is(letter) return letter.object end

--- A text whose letters, words or lines a function changes: it returns an object, or nil for
--- nothing. With `along`, path data or a path, the text runs along it; a letter then has `degrees`.
---@param text celspan.text.fields
---@param change? fun(letter: celspan.letter, i: integer, n: integer): celspan.object?
---@param options? { by?: "letter"|"word"|"line", along?: string|celspan.contour[]|celspan.shape, start?: number } start: a share of the path; of an open one 0.5 by default for align = "centre", and 1 for "right"
---@return celspan.object
function layout.letters(text, change, options)
  options = options or {}
  fields.check("letters", options, { by = "string", along = "any", start = "number" })
  local by = options.by or "letter"
  if by ~= "letter" and by ~= "word" and by ~= "line" then
    refuse("letters: field 'by' must be \"letter\", \"word\" or \"line\", got %q", by)
  end
  fields.expect_kind(change == nil or type(change) == "function", change,
    "letters: the second argument must be a function")
  local groups, shown, objects = groups_of(celspan.glyphs(text), by), {}, {}
  local curve = options.along and curves.read("letters", options.along)
  local start = options.start or curve and not curve.is_closed and starts[text.align] or 0
  for _, group in ipairs(groups) do
    if not group.text:find(BLANK) then
      group.object = #group.objects == 1 and group.objects[1] or celspan.union(group.objects)
      group.objects, group.is_blank = nil, nil
      if not curve or ride(group, curve, start, text.at and text.at[1] or text[2] or 0) then
        shown[#shown + 1] = group
      end
    end
  end
  for i, group in ipairs(shown) do
    objects[#objects + 1] = (change or as_it_is)(group, i, #shown)
  end
  return celspan.union(objects)
end

return fields.seal("layout", layout)
