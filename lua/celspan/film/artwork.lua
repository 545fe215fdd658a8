--- Artwork as a film: what `celspan render drawing.svg` shows.
--
--   .svg, .ora, .kra, .psd     the whole file at its own size: one frame, or for a drawing that
--                              moves FPS frames for each second
--   .json, .lottie             the animation; its slots and themes are parameters
--   a movie, x.####.png        its pictures, one a frame; the sound, what else goes with the
--                              pictures, and of files the rate, are parameters
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local json = require "celspan.json"
local layers = require "celspan.layers"
local ordered = require "celspan.ordered"
local parameters = require "celspan.parameters"
local svg = require "celspan.svg"

local artwork = {}

local FPS = 24
local MOST = 24 * 3600 * FPS -- frames: a day

--- The result of a reader. Raises an error with the reader's message, and without a line of this
--- file.
local function needed(value, message)
  return value or error((message:gsub("^celspan/artwork%.lua:%d+: ", "")), 0)
end

--- A note, and what to do about it.
local function with_advice(note)
  local lacks_font = note:find("no font is given", 1, true)
  return lacks_font and note .. ": 'celspan render --set font=FILE' gives one" or note
end

--- The number of frames of a drawing that moves.
local function frames_of(art, notes)
  local count = math.max(1, math.floor(math.min(art.seconds * FPS, MOST) + 0.5))
  if art.seconds * FPS > MOST then
    notes[#notes + 1] = ("it moves for %g s; the film ends after a day"):format(art.seconds)
  end
  return count
end

--- A drawing, its size, sentences about what is left out, and for one that moves, the number of
--- frames and its cels at a time. The parameter `font` of the film is a file for all texts.
local function drawing(path)
  local font = parameters.declare { font = { "", about = "A font file for the texts" } }.font
  local art = needed(svg.read(path, { fonts = font ~= "" and { default = font } or nil }))
  local notes = {}
  for i, note in ipairs(art.skipped) do
    notes[i] = ("line %d: %s"):format(note.line, with_advice(note.what))
  end
  local function at(seconds) return { celspan.cel { art:at(seconds) } } end
  -- what is set for ever at the beginning has no end, and so no seconds
  if not art.seconds then return at(0), art.width, art.height, notes end
  return at(0), art.width, art.height, notes, frames_of(art, notes), at
end

local function painting(path)
  local tree = needed(layers.read(path))
  local notes = {}
  for i, note in ipairs(tree.skipped) do
    notes[i] = note.layer == "" and note.what or note.layer .. ": " .. note.what
  end
  local cels = tree:cels()
  cels.space = "srgb" -- as in painting programs, and as `tree.object` is
  return cels, tree.width, tree.height, notes
end

-- ---------------------------------------------------------------- Lottie

--- A name that a parameter may have.
local function word(name)
  local made = name:gsub("[^%w_]", "_")
  return made:find "^%d" and "_" .. made or made
end

--- How the parameter of a slot is declared, by its kind; `about` is added.
local declare = {
  colour = function(value) return { colour = value or "#000000" } end,
  number = function(value) return { value or 0 } end,
  text = function(value) return { value or "" } end,
  list = function(value) return { table.concat(value or {}, ", ") } end,
}

--- The parameters of an animation: `font`, `theme` where it has some, and its slots. Returns them,
--- and the slots by parameter.
local function parameters_of(art)
  local wanted = { font = { "", about = "A font file for the texts" } }
  local by_name = {}
  if #art.themes > 0 then
    wanted.theme = { "", table.unpack(art.themes) }
    wanted.theme.about = "A theme of the file"
  end
  for _, slot in ipairs(ordered.names(art.slots)) do
    local one, name = art.slots[slot], word(slot)
    if declare[one.kind] and not wanted[name] then
      wanted[name] = declare[one.kind](one.value)
      wanted[name].about = ("The slot '%s'"):format(slot)
      by_name[name] = { slot = slot, default = wanted[name].colour or wanted[name][1] }
    end
  end
  return wanted, by_name
end

--- The animation as a film, and notes about what looks different.
local function animation(path)
  local lottie = require "celspan.lottie" -- it is large, and few films need it
  local art = needed(lottie.read(path))
  local wanted, by_name = parameters_of(art)
  local given, set = parameters.declare(wanted), {}
  for name, one in pairs(by_name) do
    if given[name] ~= one.default then set[one.slot] = given[name] end
  end
  local options = {
    set = next(set) and set, fonts = given.font ~= "" and { default = given.font } or nil,
    theme = wanted.theme and given.theme ~= "" and given.theme or nil,
  }
  if next(options) then art = needed(lottie.read(path, options)) end
  return art:film():with { title = path:match "[^/]*$" }, art.skipped
end

-- ---------------------------------------------------------------- footage

--- The parameters of pictures.
local function declare_given(more)
  local wanted = {
    sound = { "", about = "A sound instead of the file's own" },
    title = { "", about = "The title" },
    marks = { "", about = "Names of frames, in JSON: {\"title\": 1}" },
    captions = { "", about = "A .srt or .vtt file" },
    poster = { 0, min = 0, about = "The frame that stands for the film; 0: none" },
  }
  for name, one in pairs(more) do wanted[name] = one end
  return parameters.declare(wanted)
end

--- The marks in a text, without those of frames after the last one.
local function marks_in(text, frames)
  if text == "" then return nil end
  local marks = json.decode(text)
  if type(marks) ~= "table" then error("the parameter 'marks' is not an object of JSON", 0) end
  for name, frame in pairs(marks) do
    if type(frame) == "number" and frame > frames then marks[name] = nil end
  end
  return marks
end

local function unless(value, none) return value ~= none and value or nil end

--- The pictures of a clip as a film with what is given. A frame shows what the clip shows at its
--- middle: where the rate varies, pictures are held or left out.
local function shown(clip, path, given)
  local w, h = clip.size[1], clip.size[2]
  local frames = math.max(1, math.floor(clip.seconds * clip.fps + 0.5))
  return celspan.film {
    size = clip.size, fps = clip.fps, frames = frames,
    title = unless(given.title, "") or path:match "[^/]*$",
    sound = unless(given.sound, "") or clip.sound and path or nil,
    marks = marks_in(given.marks, frames), captions = unless(given.captions, ""),
    poster = given.poster > 0 and given.poster <= frames and given.poster or nil,
    frame = function(f)
      return celspan.rostrum { celspan.cel {
        celspan.rect { 0, 0, w, h, texture = clip:at(f.middle) } } }
    end,
  }
end

local function movie(path)
  if not native.is_movie((native.find(path))) then return nil end
  return shown(celspan.footage { file = path }, path, declare_given {})
end

local function files(path)
  local given = declare_given {
    fps = { FPS, min = 0.01, max = 1000, about = "Frames per second" } }
  return shown(celspan.footage { file = path, fps = given.fps }, path, given)
end

--- What is not shown of it is passed to `show`. nil: the file is not of this kind.
---@param path string Beside the script, else relative to the current folder
---@param kind "svg"|"painting"|"lottie"|"movie"|"files"
---@param show fun(line: string)
---@return celspan.film? film
function artwork.film(path, kind, show)
  if kind == "movie" then return movie(path) end
  if kind == "files" then return files(path) end
  if kind == "lottie" then
    local film, skipped = animation(path)
    for _, note in ipairs(skipped) do show(("%s: %s"):format(path, with_advice(note))) end
    return film
  end
  local cels, width, height, notes, frames, at = (kind == "svg" and drawing or painting)(path)
  for _, note in ipairs(notes) do show(("%s: not shown: %s"):format(path, note)) end
  local rostrum = celspan.rostrum(cels)
  return celspan.film {
    size = { math.max(1, math.ceil(width)), math.max(1, math.ceil(height)) },
    title = path:match "[^/]*$", frames = frames, fps = frames and FPS,
    frame = function(f) return at and celspan.rostrum(at(f.time)) or rostrum end,
  }
end

return fields.seal("artwork", artwork)
