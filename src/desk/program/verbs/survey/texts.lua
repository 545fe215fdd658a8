--- The texts of a film: where and how long each is shown, and how well it can be read.
--
--   frame 1   "Hel"         a text is the same one as in the frame before if the same line made it,
--   frame 2   "Hello"       and it has the same words except for numbers, or begins with the same:
--   frame 3   "Hello"       what is typed or counts up is one text
--
--   letters, alone -----> how much of each pixel they cover (a)
--   the frame ----------> luminance = ground + a * (letters - ground), fitted over all pixels
--   nearer cels, alone -> how much of the letters they cover
--
-- A text is measured in its 1st, 2nd, 4th, 8th ... frame, since it may appear slowly, and in every
-- frame as long as it could not be read. Two texts are compared in the same way, in the frames in
-- which both are clearly there, since one may pass the other, or follow it in a dissolve.
local script = ...

local texts = {}
texts.__index = texts

local MOST = 1000            -- texts that are kept
local CONTRAST, COVERED = 3, 0.9
local SMALL = 1 / 72          -- share of the frame's height: 15 of 1080 pixels
local CROSSED = 0.05         -- the share of letters that another text may cover
local LOOKED = 50            -- texts of a frame, from the farthest, that are measured and compared
local CLEAR, RATIO = 0.6, 3  -- the least fade of such texts, and the greatest ratio of their sizes
local EM, PIXELS = 24, 1 << 14 -- the size of letters, and of pictures, for measuring

function texts.new() return setmetatable({ list = {}, shown = {} }, texts) end

-- ---------------------------------------------------------------- the texts of a frame

local function join_boxes(a, b)
  local x, y = math.min(a[1], b[1]), math.min(a[2], b[2])
  return { x, y, math.max(a[1] + a[3], b[1] + b[3]) - x, math.max(a[2] + a[4], b[2] + b[4]) - y }
end

--- The words of a text, with all numbers replaced by the same sign.
local function outline_of(words) return (words:gsub("%d[%d.,\u{a0}\u{202f}']*", "0")) end

local function new_text(part, words, em)
  return { words = words, outline = outline_of(words), number = part.words, box = part.box,
           pixels = em * part.scale, over = part.over, fade = part.fade,
           file = part.file, line = part.line,
           alone = { { part.alone, 1 } }, hash = part.drawing .. part.placement }
end

--- The texts among the parts of a frame. Letters of one text that follow each other are joined.
local function texts_of(parts)
  local found = {}
  for _, part in ipairs(parts) do
    local words, em, is_letter
    if part.kind == "text" then words, em, is_letter = script:words(part.words) end
    local last = found[#found]
    if words and part.box and part.fade > 0 then
      if is_letter and last and last.is_open and last.number == part.words then
        last.box, last.hash = join_boxes(last.box, part.box), last.hash .. part.placement
        last.alone[#last.alone + 1] = { part.alone, 1 }
      else
        if last then last.is_open = false end
        found[#found + 1] = new_text(part, words, em)
        found[#found].is_open = is_letter
      end
    end
  end
  return found
end

-- ---------------------------------------------------------------- the same text

local function continues(shown, text)
  if shown.is_met or shown.line ~= text.line or shown.file ~= text.file then return false end
  local a, b = shown.outline, text.outline
  return a == b or a:sub(1, #b) == b or b:sub(1, #a) == a
end

local function distance(a, b)
  return math.abs(a[1] - b[1]) + math.abs(a[2] - b[2])
end

--- The text of the previous frame that is the same as this one: the nearest; nil: none.
local function find(shown, text)
  local best
  for _, one in ipairs(shown) do
    if continues(one, text)
      and (not best or distance(one.box, text.box) < distance(best.box, text.box)) then
      best = one
    end
  end
  return best
end

-- ---------------------------------------------------------------- measuring

--- The view in which the letters of a text are large enough: the size of the whole frame, and the
--- crop; nil: the text is not in the frame.
local function view_of(text)
  local w, h = script.size[1], script.size[2]
  local x0, y0 = math.max(0, text.box[1]), math.max(0, text.box[2])
  local x1 = math.min(w, text.box[1] + text.box[3])
  local y1 = math.min(h, text.box[2] + text.box[4])
  if x1 <= x0 or y1 <= y0 or text.pixels <= 0 then return nil end
  local scale = math.min(EM / text.pixels, math.sqrt(PIXELS / ((x1 - x0) * (y1 - y0))))
  local size = { math.ceil(w * scale), math.ceil(h * scale) }
  local sx, sy = size[1] / w, size[2] / h
  local left, top = math.floor(x0 * sx), math.floor(y0 * sy)
  return { size = size, crop = { left, top, math.min(size[1], math.ceil(x1 * sx)) - left,
                                 math.min(size[2], math.ceil(y1 * sy)) - top } }
end

--- The slope and the offset of the line through pairs of values; nil: all xs are equal.
local function fit(xs, ys)
  local n, sx, sy, sxx, sxy = #xs, 0, 0, 0, 0
  for i = 1, n do
    sx, sy, sxx, sxy = sx + xs[i], sy + ys[i], sxx + xs[i] * xs[i], sxy + xs[i] * ys[i]
  end
  local spread = n * sxx - sx * sx
  if spread <= 1e-9 then return nil end
  local slope = (n * sxy - sx * sy) / spread
  return slope, (sy - slope * sx) / n
end

--- The contrast between the letters and their background, by WCAG; nil: the letters cover all or
--- nothing.
local function contrast_of(alphas, lights)
  local slope, ground = fit(alphas, lights)
  if not slope then return nil end
  local letters = math.max(0, ground + slope * math.max(table.unpack(alphas)))
  ground = math.max(0, ground)
  return (math.max(letters, ground) + 0.05) / (math.min(letters, ground) + 0.05)
end

--- The share of the letters that nearer cels cover.
local function cover_of(alphas, over)
  local sum, covered = 0, 0
  for i, alpha in ipairs(alphas) do
    sum, covered = sum + alpha, covered + alpha * over[i]
  end
  return sum > 0 and covered / sum or 0
end

--- Measures how well a text can be read in the frame that was built last: updates the greatest
--- contrast, and the least share that nearer cels cover.
local function measure(shown, text, look)
  local view = view_of(text)
  if not view then return end
  local _, alphas = look(text.alone, view)
  local lights = look(script:exposures(), view)
  if not alphas or not lights then return end
  local contrast = contrast_of(alphas, lights)
  shown.contrast = contrast and math.max(shown.contrast or 0, contrast) or shown.contrast
  local over
  if text.over and (shown.covered or 1) > 0 then
    over = select(2, look({ { text.over, 1 } }, view))
  end
  shown.covered = math.min(shown.covered or 1, over and cover_of(alphas, over) or 0)
end

--- Whether a frame of a text is measured. age: which of the frames of the text it is.
local function is_measured(shown, age)
  return age & (age - 1) == 0 or (shown.contrast or 0) < CONTRAST
    or (shown.covered or 0) >= COVERED
end

-- ---------------------------------------------------------------- texts over texts

local function meet(a, b)
  return a[1] < b[1] + b[3] and b[1] < a[1] + a[3] and a[2] < b[2] + b[4] and b[2] < a[2] + a[4]
end

--- Whether two texts are different ones that a viewer would read: not letters of decoration behind
--- a text, nor a text on its own copy, of which it may have only the first words.
local function are_rivals(a, b)
  local ratio = a.pixels / b.pixels
  return math.min(a.fade, b.fade) >= CLEAR and ratio <= RATIO and ratio >= 1 / RATIO
    and not a.outline:find(b.outline, 1, true) and not b.outline:find(a.outline, 1, true)
end

--- The share of the letters of `text` that the letters of `nearer` cover.
local function crossed_by(text, nearer, look)
  local view = view_of(text)
  if not view then return 0 end
  local _, alphas = look(text.alone, view)
  local _, over = look(nearer.alone, view)
  return alphas and over and cover_of(alphas, over) / nearer.fade or 0
end

--- What is known of two texts, of which `near` is in front; it begins when their boxes meet.
local function pair_of(far, near, do_meet)
  for _, pair in ipairs(far.under) do
    if pair.near == near then return pair end
  end
  if not do_meet then return nil end
  local pair = { near = near, age = 0, share = 1 }
  table.insert(far.under, pair)
  table.insert(near.above, pair)
  return pair
end

--- Updates the least share of a text that a nearer one covers, for a frame that has both.
local function add_pair(far, near, look)
  local do_meet = meet(far.text.box, near.text.box)
  local pair = pair_of(far.shown, near.shown, do_meet)
  if not pair then return end
  pair.age = pair.age + 1
  if not do_meet then
    pair.share = 0
  elseif pair.share >= CROSSED and pair.age & (pair.age - 1) == 0 then
    pair.share = math.min(pair.share, crossed_by(far.text, near.text, look))
  end
end

--- Compares the texts of a frame, from the farthest: { text =, shown = } each. A text with the same
--- words in front of it is the shadow of this one.
local function add_pairs(met, look)
  for i = 1, math.min(#met, LOOKED) do
    for k = i + 1, math.min(#met, LOOKED) do
      local far, near = met[i], met[k]
      if are_rivals(far.text, near.text) then add_pair(far, near, look) end
      far.shown.is_copied = far.shown.is_copied or far.text.outline == near.text.outline
        and meet(far.text.box, near.text.box)
    end
  end
end

--- The pair of a list with the greatest share that is covered; nil: none is covered.
local function crossing(pairs_of)
  local worst
  for _, pair in ipairs(pairs_of) do
    if pair.share >= (worst and worst.share or CROSSED) then worst = pair end
  end
  return worst
end

-- ---------------------------------------------------------------- frames

--- Adds the sides of the frame inside which the whole text lies: left, top, right, bottom.
local function add_sides(shown, box)
  local inside = { box[1] >= -0.5, box[2] >= -0.5, box[1] + box[3] <= script.size[1] + 0.5,
                   box[2] + box[4] <= script.size[2] + 0.5 }
  for i = 1, 4 do shown.inside[i] = shown.inside[i] or inside[i] end
end

--- The share of the frame that a box covers.
function texts.share_of(box)
  local w = math.min(script.size[1], box[1] + box[3]) - math.max(0, box[1])
  local h = math.min(script.size[2], box[2] + box[4]) - math.max(0, box[2])
  return math.max(0, w) * math.max(0, h) / (script.size[1] * script.size[2])
end

--- Begins a text in a frame.
function texts:begin(text, frame)
  local shown = { words = text.words, first = frame, file = text.file, line = text.line,
                  pixels = 0, share = 0, inside = {}, under = {}, above = {}, moves = false }
  if #self.list < MOST then self.list[#self.list + 1] = shown else self.has_more = true end
  return shown
end

--- Adds the frame `number`, which was built last, with its parts. look(exposures, view) returns the
--- luminances and the alphas of a picture.
function texts:add(number, parts, look)
  local now, met = {}, {}
  for _, one in ipairs(self.shown) do one.is_met = false end
  for _, text in ipairs(texts_of(parts)) do
    local shown = find(self.shown, text)
    shown = shown or self:begin(text, number)
    shown.moves = shown.moves or shown.hash ~= nil and shown.hash ~= text.hash
    shown.is_met, shown.last, shown.hash, shown.box = true, number, text.hash, text.box
    shown.outline = text.outline
    if #text.words >= #shown.words then shown.words = text.words end
    shown.pixels = math.max(shown.pixels, text.pixels)
    shown.share = math.max(shown.share, texts.share_of(text.box))
    add_sides(shown, text.box)
    if #met < LOOKED and is_measured(shown, number - shown.first + 1) then
      measure(shown, text, look)
    end
    now[#now + 1], met[#met + 1] = shown, { text = text, shown = shown }
  end
  add_pairs(met, look)
  self.shown = now
end

--- Adds a frame that shows the same as the previous one.
function texts:again(number)
  for _, shown in ipairs(self.shown) do shown.last = number end
end

--- Called when the next frame does not follow the previous one.
function texts:cut() self.shown = {} end

-- ---------------------------------------------------------------- what is wrong

local SIDES = { "left", "upper", "right", "lower" }
local WORD, START = 0.25, 0.5 -- seconds to read a word, and to find the text

--- How many words a text has, without dots and dashes that stand alone.
function texts.words_in(text)
  local count = 0
  text = text:gsub("\xc2[\x80-\xbf]", ""):gsub("\xe2\x80[\x80-\xbf]", "")
  for word in text:gmatch "%S+" do
    if word:find "[%w\x80-\xff]" then count = count + 1 end
  end
  return count
end

--- The seconds that a viewer needs to read this many words.
function texts.needed(count) return WORD * count + START end

local function add_outside(shown, add)
  local sides = {}
  for i = 1, 4 do
    if not shown.inside[i] then sides[#sides + 1] = SIDES[i] end
  end
  if #sides > 0 then
    add("lies outside of the frame in all of its frames, at the %s side",
      table.concat(sides, " and the "))
  end
end

--- Calls add(format, ...) for each reason why a text may be hard to read. seconds: how long it is
--- shown; nil: not known.
function texts.judge(shown, seconds, add)
  local pair = crossing(shown.under)
  add_outside(shown, add)
  if pair then
    add("has the text %s over it", texts.quoted(pair.near.words))
  elseif shown.covered and shown.covered >= COVERED then
    add("is covered by nearer cels in all of its frames, %d %% of it at least",
      math.floor(shown.covered * 100 + 0.5))
  elseif shown.contrast and shown.contrast < CONTRAST
    and not shown.is_copied and not crossing(shown.above) then
    add("has a contrast of %.1f to its background, less than %d", shown.contrast, CONTRAST)
  end
  if shown.pixels < SMALL * script.size[2] then
    add("has letters of %.3g units, less than 1/%d of the frame's height", shown.pixels,
      math.floor(1 / SMALL + 0.5))
  end
  local count = texts.words_in(shown.words)
  local needed = texts.needed(count)
  if count > 0 and seconds and seconds < needed - 1e-9 then
    add("is shown for %.4g s; its %d %s %.4g s", seconds, count,
      count == 1 and "word needs" or "words need", needed)
  end
end

--- A text in the form in which messages show it: in quotes, on one line, and not too long.
function texts.quoted(words)
  local text = words:gsub("[%c\127]+", " ")
  if (utf8.len(text) or 0) > 60 then text = text:sub(1, utf8.offset(text, 58) - 1) .. "..." end
  return '"' .. text .. '"'
end

return texts
