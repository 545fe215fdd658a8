--- Lottie animations: vector films from After Effects and other programs, as objects.
--
--   local art = assert(lottie.read "wave.json")       -- or a dotLottie file, wave.lottie
--   art.size, art.fps, art.first, art.last            -- frames of the animation's own count
--   art:at(12.5)                                      -- the object of a frame
--   art:film()                                        -- the whole as a film
--   art.skipped                                       -- lines about what looks different
local celspan = require "celspan"
local check = require "celspan.lottie_check"
local native = require "celspan.native"
local fields = require "celspan.fields"
local layers = require "celspan.lottie_layers"
local letters = require "celspan.lottie_letters"
local paint = require "celspan.lottie_paint"
local pictures = require "celspan.lottie_pictures"
local scope = require "celspan.lottie_scope"
local slots = require "celspan.lottie_slots"
local sounds = require "celspan.lottie_sounds"
local source = require "celspan.lottie_source"
local values = require "celspan.lottie_values"

local lottie = {}

local MOST_MARKERS = 100000 -- as a film has marks

---@class celspan.lottie.art
---@field size number[] Width and height, in units
---@field fps number
---@field first number Its first frame, in its own count
---@field last number The frame after its last one
---@field markers { [1]: string, [2]: number, [3]: number }[] Name, first frame, the frame after the last
---@field slots table<string, { kind: string, value: any }> What may be set, by name
---@field themes string[] Of a dotLottie file
---@field states string[] State machines of a dotLottie file, which are not run
---@field sounds table[] For the `sound` of a film
---@field skipped string[] What looks different from other players, each with its place in the JSON
local Art = fields.class("celspan.lottie", "a Lottie animation")

--- Pictures and blurred pictures by animation, both functions of the frame, hidden from scripts.
local compiled = setmetatable({}, { __mode = "k" })

-- ---------------------------------------------------------------- frames

--- What `at` and films show at a frame: the object, cut to the animation's frame, and nothing where
--- it cannot be drawn.
local function pictures_of(get, width, height, note)
  local frame = celspan.rect { 0, 0, width, height }
  local margin = math.max(width, height) / 64 -- more than a pixel, in all but icons
  local cut = paint.keep(function(object) return celspan.clip(object, frame) end)
  local averaged = paint.keep(function(object)
    return celspan.group { object:blur(margin, { kernel = "pixel" }), space = "srgb" }
  end)
  local function safely(make)
    return function(t)
      local good, object = pcall(make, t)
      if not good then note(("it cannot be drawn at frame %g: %s"):format(t, tostring(object))) end
      return good and object or celspan.union {}
    end
  end
  local function picture(t)
    local object = get(t)
    return object and cut(object)
  end
  return { plain = safely(picture), averaged = safely(function(t)
    local object = picture(t)
    return object and averaged(object)
  end) }
end

--- The animation at a frame, also between two. Its colours are mixed as sRGB codes, and so are the
--- pixels on its edges, whatever the space of the film is.
---@param frame number In the animation's own count, from `first` on
---@return celspan.object object
function Art:at(frame)
  fields.check_at("lottie", Art, self, frame, "a frame")
  return compiled[self].averaged(frame)
end

--- The name of a marker as that of a mark, which begins with no digit and has no comma or colon.
local function mark_name(name)
  local made = name:gsub("[,:]", "_"):gsub("^%s+", ""):gsub("%s+$", "")
  return made:find "^[^%d%-]" and made or "m" .. made
end

--- The animation as a film in sRGB codes. Its frames have the numbers of the animation's own count.
---@return celspan.film film
function Art:film()
  fields.self("lottie", Art, self, "film")
  local first = math.ceil(self.first)
  local marks = {}
  for _, marker in ipairs(self.markers) do
    local frame = math.floor(marker[2] + 0.5)
    if frame >= first and frame < self.last then marks[mark_name(marker[1])] = frame end
  end
  local size = { math.ceil(self.size[1]), math.ceil(self.size[2]) }
  return celspan.film {
    size = size, fps = self.fps, first = first, space = "srgb", marks = marks,
    frames = math.max(1, math.ceil(self.last) - first),
    sound = #self.sounds > 0 and self.sounds or nil,
    frame = function(f)
      return celspan.rostrum { celspan.cel { compiled[self].plain(f.number) } }
    end,
  }
end

-- ---------------------------------------------------------------- reading

local function assets_of(root, document)
  local assets = {}
  for _, one in ipairs(values.items(document.assets)) do
    local id = one[2].id
    if id ~= nil and not assets[id] then
      assets[id] = { item = one[2], scope = root.scope.within(("assets[%d]"):format(one[1] - 1)) }
      root.asset_ids[#root.asset_ids + 1] = id
    end
  end
  return assets
end

local function markers_of(root, document)
  local markers = {}
  for i, one in ipairs(values.items(document.markers)) do
    if i > MOST_MARKERS then
      root.scope.note(("there are more than %d markers; the others are left out"):format(
        MOST_MARKERS))
      break
    end
    local from = values.number(one[2].tm, 0)
    markers[i] = { values.name(one[2].cm, "marker"), from, from + values.number(one[2].dr, 0) }
  end
  return markers
end

--- What all parts of a document share while they are compiled.
local function root_of(found, options)
  local document = values.table(found.document) or {}
  local root = { skipped = {}, fps = 0, font_files = {}, chars = letters.table_of(document),
                 fonts = letters.fonts_of(document), sounds = {}, asset_ids = {} }
  root.scope = scope.new(root)
  root.assets = assets_of(root, document)
  root.pictures = pictures.reader(found, root.assets)
  root.sound_file = pictures.sounds(found, root.assets)
  for name, file in pairs(options.fonts or {}) do root.font_files[name] = native.find(file) end
  return root
end

--- Notes pictures that are missing and that no layer shows.
local function note_pictures(root)
  for _, id in ipairs(root.asset_ids) do
    local asset = root.assets[id]
    if asset.item.p ~= nil and asset.item.w ~= nil then
      local object, message = root.pictures(id)
      if not object then asset.scope.note(message) end
    end
  end
end

--- Compiles a document that has been checked.
local function compile(found, root, facts, list)
  local document = found.document
  root.fps, root.first, root.last = facts.fps, facts.first, facts.last
  root.slot, root.gradient = slots.finder(list), slots.gradients(list)
  local get = layers.compile(root.scope, document.layers)
  sounds.collect(root, document.layers)
  note_pictures(root)
  if #found.states > 0 then root.scope.note "its state machines are not run" end
  local art = setmetatable({ size = { facts.width, facts.height }, fps = facts.fps,
    first = facts.first, last = facts.last, markers = markers_of(root, document),
    themes = found.themes, states = found.states, sounds = root.sounds, skipped = root.skipped },
    Art)
  compiled[art] = pictures_of(get, facts.width, facts.height, root.scope.note)
  return art
end

---@class celspan.lottie.options
---@field fonts? table<string, string> Font files by "Family Style" or "Family"; `default` for all others
---@field theme? string The id of a theme of a dotLottie file
---@field set? table<string, any> Values by slot

local function check_names(options)
  for name, file in next, options.fonts or {} do
    if type(name) ~= "string" or type(file) ~= "string" then
      native.refuse "lottie: read: fonts are files by name, such as { default = \"sans.ttf\" }"
    end
  end
  for name in next, options.set or {} do
    if type(name) ~= "string" then
      native.refuse "lottie: read: set is values by slot, such as { tint = \"#f80\" }"
    end
  end
end

local known = { fonts = "table", theme = "string", set = "table" }

---@param path string Relative to the caller's file, else to the script
---@param options? celspan.lottie.options
---@return celspan.lottie.art? art
---@return string? message
function lottie.read(path, options)
  fields.takes("lottie: read", "string", "a file name", path)
  options = options == nil and {} or options
  fields.check("lottie: read", options, known)
  check_names(options)
  local found, message = source.open(path)
  if not found then return nil, message end
  local root = root_of(found, options)
  local facts, wrong = check.examine(found.document, root.assets)
  if not facts then return nil, ("%s: %s"):format(path, wrong) end
  local list = slots.read(found.document)
  wrong = slots.apply(found, list, options.theme or found.theme, options.set, root.scope.note)
  if wrong then return nil, ("%s: %s"):format(path, wrong) end
  local art = compile(found, root, facts, list)
  wrong = slots.finish(list)
  if wrong then return nil, ("%s: %s"):format(path, wrong) end
  art.slots = slots.list(list)
  return art
end

--- lottie.read for an animation that must be readable: raises an error if it is not.
---@param path string Relative to the caller's file, else to the script
---@param options? celspan.lottie.options
---@return celspan.lottie.art art
function lottie.load(path, options)
  local art, message = lottie.read(path, options)
  return art or native.refuse("lottie: " .. message)
end

return fields.publish("lottie", lottie, Art)
