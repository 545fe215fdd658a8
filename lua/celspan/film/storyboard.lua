--- Storyboarder's boards as an animatic: panels one after another, each for its own time.
--
--   board.storyboarder     JSON: milliseconds and dialogue of each board, and its layers
--   images/                the pictures of the layers, rearmost first as in LAYERS
local celspan = require "celspan"
local native = require "celspan.native"
local ordered = require "celspan.ordered"
local timecode = require "celspan.timecode"
local values = require "celspan.values"

local storyboard = {}

local SIDE = 900 -- pixels of the shorter side of a board
local LONGEST = 1e8 -- milliseconds of a board
local LAYERS = { "shot-generator", "reference", "fill", "tone", "pencil", "ink", "notes" }

local number_of, table_of, text_of = values.number, values.table, values.text

--- A file in the folder of the pictures; nil and a sentence in `skipped` if it is not there.
local function file_of(state, place, url)
  local found = url and native.within(state.folder, "images/" .. url)
  if url and not found then values.skip(state, "%sthere is no images/%s", place, url) end
  return found
end

--- What a panel shows: its layers on white paper.
local function drawing_of(state, board, place)
  local w, h = table.unpack(state.size)
  local list = { celspan.rect { 0, 0, w, h, texture = "#fff" } }
  for _, name in ipairs(LAYERS) do
    local layer = table_of(table_of(board.layers)[name])
    local file = file_of(state, place, text_of(layer.url))
    local opacity = number_of(layer, place, "opacity", 0, 1, 1)
    list[#list + 1] = file and celspan.image { file = file, w = w, h = h }:fade(opacity) or nil
  end
  return list
end

--- The frame at which a time begins.
local function frame_at(state, milli) return math.floor(milli * state.fps / 1000 + 0.5) end

--- Adds a panel that begins at `milli`, if it lasts a frame. Returns the milliseconds at its end.
local function add_panel(state, board, place, milli)
  local stop = milli + number_of(board, place, "duration", 0, LONGEST, state.default)
  local first, last = frame_at(state, milli), frame_at(state, stop)
  if first == last then return stop end
  local from, to, said = first / state.fps, last / state.fps, text_of(board.dialogue)
  state.panels[#state.panels + 1] = { first = first, drawing = drawing_of(state, board, place) }
  state.shots[#state.shots + 1] = { name = text_of(board.shot) or place:match "%d+", from = from,
    to = to, source = { from = 0, to = to - from }, dialogue = said, action = text_of(board.action),
    notes = text_of(board.notes) }
  if said then state.captions[#state.captions + 1] = { from = from, to = to, text = said } end
  local sound = file_of(state, place, text_of(table_of(board.audio).filename))
  if sound then state.sounds[#state.sounds + 1] = { sound, at = from } end
  return stop
end

--- Reads a storyboard, for cut.read. folder: that of the file, with / at its end.
---@return celspan.film film
---@return table shots
function storyboard.read(text, folder)
  local document = values.decode(text, "the storyboard")
  if type(document.boards) ~= "table" then values.fail "is no storyboard: it has no boards" end
  local aspect = number_of(document, "", "aspectRatio", 0.01, 100, 16 / 9)
  local state = { fps = (timecode.rate(number_of(document, "", "fps", 1, 1000, 24))),
    default = number_of(document, "", "defaultBoardTiming", 0, LONGEST, 2000),
    size = { math.floor(SIDE * math.max(1, aspect) + 0.5),
             math.floor(SIDE / math.min(1, aspect) + 0.5) },
    folder = folder, panels = {}, shots = {}, captions = {}, sounds = {}, skipped = {} }
  local milli = 0
  for board, place in values.each(document, "", "boards", nil, "board %d: ") do
    milli = add_panel(state, board, place, milli)
  end
  local panels = state.panels
  if #panels == 0 then values.fail "has no board that lasts a frame" end
  state.shots.skipped = state.skipped
  return celspan.film { size = state.size, fps = state.fps, frames = frame_at(state, milli),
    captions = state.captions, sound = state.sounds,
    frame = function(f) return panels[ordered.last(panels, f.index, "first")].drawing end,
  }, state.shots
end

return require "celspan.fields".seal("storyboard", storyboard)
