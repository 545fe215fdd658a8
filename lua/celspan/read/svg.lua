--- Drawings from SVG files: one object, and its parts by name.
--
--   local art = assert(svg.read "hero.svg")
--   art.object                      -- the whole, from (0, 0) to art.width, art.height
--   art.parts.arm                   -- the element with this id, or with this Inkscape label
--   svg.read("sign.svg", { fonts = { Arial = "arial.ttf", default = "sans.ttf" } })   -- for text
--   svg.read("glass.svg", { space = "linear" })   -- what is translucent mixes as light
--   art:at(1.5)                     -- the whole, 1.5 seconds after its animations began
--   art:with { arm = function(arm) return arm:rotate(20, 140, 90) end }
--   art:with { arm = { pivot = { 140, 90 } } }     -- for arm:rotate(20, "pivot")
--   art:show { mouth = "C", eyes = "open" }     -- of the parts "mouth A", "mouth B", ... only C
--
-- A file is read once and kept from frame to frame until it changes, so that frame functions may
-- read it.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local files = require "celspan.files"
local ordered = require "celspan.ordered"
local sets = require "celspan.sets"

local svg = {}

---@class celspan.svg.skipped
---@field line integer Of the file
---@field what string The part that is not drawn

---@class celspan.svg.art
---@field object celspan.object The whole drawing
---@field width number In px of the file
---@field height number
---@field parts table<string, celspan.object> By id, or by Inkscape label if only one element has it
---@field skipped celspan.svg.skipped[] The parts that were not drawn
---@field seconds? number How long it moves: up to the end of the last animation that ends, or the longest period where all repeat for ever
local Art = fields.class("celspan.svg", "a drawing", { seconds = true, __move = true,
                                                           __pivots = true })

--- What moves a drawing that is being read to a time (mover.h); nil: returns how long it moves.
--- What its documents say is kept: its own, and those of drawings that are images of it.
local function clock()
  local plans = {}
  return function(mover, seconds, key)
    -- they are large, and few drawings move
    local smil, styles = require "celspan.svg_smil", require "celspan.svg_styles"
    local plan = plans[key] or { smil.read(mover), styles.read() }
    plans[key] = plan
    if seconds then
      smil.move(mover, plan[1], seconds)
      styles.move(mover, plan[2], seconds)
      return 0
    end
    local finish, period = smil.measure(plan[1])
    local later, longer = styles.measure(mover, plan[2])
    finish = math.max(finish, later)
    return finish > 0 and finish or math.max(period, longer)
  end
end

--- Drawings by the key of the core's cached drawing, as long as references to them exist.
local known = setmetatable({}, { __mode = "v" })

--- move: of a drawing that was read (`clock`).
local function wrap(drawing, move)
  local key = drawing:key()
  if known[key] then return known[key] end
  local width, height = drawing:size()
  local parts = drawing:parts()
  setmetatable(parts, { __index = fields.reads("the drawing's list of parts", {}) })
  known[key] = setmetatable({ object = drawing:object(), width = width, height = height,
                              parts = parts, skipped = drawing:skipped(),
                              seconds = drawing:seconds(), __drawing = drawing,
                              __move = move }, Art)
  return known[key]
end

--- The whole drawing at a time: seconds after its animations began. Another time is another object,
--- and a drawing that does not move is the same at all times. The changes of `with` and `show` are
--- not in it.
---@param seconds number
---@return celspan.object object
function Art:at(seconds)
  fields.check_at("svg", Art, self, seconds, "a time")
  if seconds < 0 or seconds > 1e12 then
    native.refuse(("svg: at takes seconds from 0 to 1e12, got %s"):format(seconds))
  end
  if not self.__move then
    native.refuse "svg: a drawing with changes has no times; take `at` of the drawing that was read"
  end
  local drawing, message = self.__drawing:at(seconds, self.__move)
  return drawing and drawing:object() or native.refuse("svg: " .. message)
end

local NUMBERED = "; it has none with a name: 'celspan info FILE --parts-picture parts.png' shows "
  .. "the numbers of its elements, for with { [\"#7\"] = ... }"

--- Refuses a name that no part has; `names` are those of all parts.
local function check_part(art, name, names)
  local is_known = type(name) == "string" and rawget(art.parts, name) ~= nil
  if type(name) == "string" and name:find "^#%d+$" and not is_known then
    for _, element in ipairs(art.__drawing:elements()) do
      is_known = is_known or element.name == name
    end
  end
  if not is_known then
    native.refuse(("svg: the drawing has no part '%s'%s"):format(fields.key(name),
      fields.hint(name, names) or #names == 0 and NUMBERED or ""))
  end
end

--- The drawing with the pivots of its parts.
local function pivoted(art, pivots)
  if not next(pivots) then return art end
  local copy, parts = { __pivots = pivots }, setmetatable({}, getmetatable(art.parts))
  for name, part in next, art.parts do
    parts[name] = pivots[name] and part:with { pivot = pivots[name] } or part
  end
  for field, value in next, art do copy[field] = copy[field] or value end
  copy.parts = parts
  return setmetatable(copy, Art)
end

--- A function that gives a part its pivot before its change, and notes where the change takes it.
local function change_of(change, pivot, note)
  return pivot and function(object)
    local moved = change(object:with { pivot = pivot })
    if getmetatable(moved) == "celspan.object" then note(moved.pivot) end
    return moved
  end or change
end

--- The drawing with parts replaced, inner parts first. Clips, opacity and order of their ancestors
--- are kept. A part that `use` shows is changed wherever it is visible. A table { pivot = } gives a
--- part the point that "pivot" means in later changes: { x, y }, or a place such as "top".
---@param changes table<string, (fun(object: celspan.object): celspan.object)|{ pivot: celspan.point|string }>
---@return celspan.svg.art
function Art:with(changes)
  fields.self("svg", Art, self, "with")
  fields.takes("svg: with", "table", "a table of functions by part", changes)
  local names, functions, pivots = ordered.names(self.parts), {}, {}
  for name, pivot in next, self.__pivots or {} do pivots[name] = pivot end
  for name, change in next, changes do
    check_part(self, name, names)
    if type(change) == "table" and rawget(self.parts, name) then
      fields.check(("svg: part '%s'"):format(name), change, { pivot = "any" })
      pivots[name] = self.parts[name]:with { pivot = change.pivot }.pivot
    else
      fields.expect_kind(type(change) == "function", change,
        "svg: part '%s' must have a function", name)
      functions[name] = change_of(change, pivots[name], function(to) pivots[name] = to end)
    end
  end
  if not next(functions) then return pivoted(self, pivots) end
  return pivoted(wrap(self.__drawing:with(functions)), pivots)
end

---@class celspan.svg.element
---@field name string "#7": its number among the elements of the file, for `with`
---@field tag string "path", "g", ...
---@field id? string
---@field label? string
---@field class? string
---@field fill? string "#rrggbb" of a shape or a text with one colour
---@field line integer Of the file
---@field depth integer How many of the elements before it in the list contain it
---@field object celspan.object

local wanted = { tag = "string", class = "string", fill = "string", id = "string", label = "string",
                 line = "number" }

--- Whether one of the words between blanks is this one.
local function has_word(text, word)
  return text and (" " .. text:gsub("%s+", " ") .. " "):find(" " .. word .. " ", 1, true) ~= nil
end

--- "#F80" as "#ff8800", the form that elements have.
local function long(colour)
  local short = colour:lower():match "^#(%x%x%x)$"
  return short and "#" .. short:gsub(".", "%0%0") or colour:lower()
end

local function goes_with(element, what)
  for field, value in next, what do
    local given = element[field]
    if field == "fill" then value = long(value) end
    if field == "class" and not has_word(given, value) then return false end
    if field ~= "class" and given ~= value then return false end
  end
  return true
end

--- The elements that are drawn, with and without names: all of them, or those with a tag, class,
--- fill, ...
---@param what? { tag?: string, class?: string, fill?: string, id?: string, label?: string, line?: integer }
---@return celspan.svg.element[]
function Art:elements(what)
  fields.self("svg", Art, self, "elements")
  fields.check("svg: elements", what or {}, wanted)
  local found = {}
  for _, element in ipairs(self.__drawing:elements()) do
    if goes_with(element, what or {}) then found[#found + 1] = element end
  end
  return found
end

local function nothing() return celspan.union {} end

--- The names for `with`: of parts, and of children of parts, such as "mouth/C".
local function paths_of(art)
  local paths = {}
  for name in pairs(art.parts) do paths[name] = name end
  for _, child in ipairs(sets.children(art:elements(), art.parts)) do
    local element = child.element
    local part = element.label and rawget(art.parts, element.label) and element.label
      or element.id and rawget(art.parts, element.id) and element.id
    paths[child.name] = paths[child.name] or part or element.name
  end
  return paths
end

--- The drawing with one part of each set: for { mouth = "C" }, of "mouth A", "mouth B" and "mouth
--- C", or of the children "A", "B" and "C" of a group "mouth", only the last one. false: none of
--- them.
---@param choices table<string, string|false>
---@return celspan.svg.art
function Art:show(choices)
  fields.self("svg", Art, self, "show")
  fields.takes("svg: show", "table", "a table of names by set", choices)
  local changes, paths = {}, paths_of(self)
  for _, name in ipairs(sets.hidden("svg: show", "the drawing", paths, choices)) do
    changes[paths[name]] = nothing
  end
  return self:with(changes)
end

---@class celspan.svg.options
---@field fonts? table<string, string> Font files by family as in `font-family`, for instance "Arial" and "Arial Bold"; `default` for all others
---@field space? "srgb"|"linear" In which colours are mixed: "srgb", as other programs do, unless another is given

--- The fonts as a list, sorted by family.
local function list_fonts(options)
  local list = {}
  for family, file in next, options.fonts or {} do
    if type(family) ~= "string" or type(file) ~= "string" then
      native.refuse(("svg: fonts is a table of files by family, such as { Arial = \"arial.ttf\" }, "
        .. "got %s = %s"):format(fields.key(family), fields.kind(file)))
    end
    list[#list + 1] = { family, native.find(file) }
  end
  table.sort(list, function(a, b) return a[1] < b[1] end)
  return list
end

---@param path string Relative to the caller's file, else to the script
---@param options? celspan.svg.options
---@return celspan.svg.art? art
---@return string? message
function svg.read(path, options)
  fields.takes("svg: read", "string", "a file name", path)
  options = options == nil and {} or options
  fields.check("svg: read", options, { fonts = "table", space = "any" })
  fields.space("svg", options.space)
  local move = clock()
  local drawing, message = files.found(path, native.read_svg, list_fonts(options),
    options.space or "srgb", move)
  if drawing then return wrap(drawing, move) end
  return nil, message
end

--- svg.read for a drawing that must be readable: raises an error if it is not.
---@param path string Relative to the caller's file, else to the script
---@param options? celspan.svg.options
---@return celspan.svg.art art
function svg.load(path, options)
  local art, message = svg.read(path, options)
  return art or native.refuse("svg: " .. message)
end

return fields.publish("svg", svg, Art)
