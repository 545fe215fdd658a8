--- What a verb prints of a thing: lines of text, or with --json all of them as one object.
--
--   facts:add("size", { 320, 180 })                      size 320x180     "size": [320, 180]
--   facts:item("marks", mark, "mark %d %s", 49, "run")   mark 49 run      "marks": [{ ... }]
--
-- Lines are printed at once and the object at the end, so that a verb that fails prints none.
local program, request = ...

local facts = { object = {}, is_json = request.json }

local function shown(value)
  if type(value) == "table" then return shown(value[1]) .. "x" .. shown(value[2]) end
  return math.type(value) == "float" and ("%.9g"):format(value) or tostring(value)
end

--- Adds a line to the text only. Names come from scripts and files, so characters that could end a
--- line become spaces.
function facts:line(format, ...)
  if not self.is_json then io.write(format:format(...):gsub("[%c\127]", " "), "\n") end
end

--- Sets a value of the object only.
function facts:set(name, value) self.object[name] = value end

function facts:add(name, value)
  self:set(name, value)
  self:line("%s %s", name, shown(value))
end

--- Lists that the object always has, even if they are empty.
function facts:lists(...)
  for _, name in ipairs { ... } do self.object[name] = { list = {} } end
end

--- Adds an item to one of the lists.
function facts:item(name, value, ...)
  if self.is_json then table.insert(self.object[name].list, value) end
  self:line(...)
end

function facts:finish()
  if self.is_json then print(program.json(self.object)) end
end

return facts
