--- `celspan render -o film.svg`, film.json or film.plane in a page: what is made goes to page.save,
--- and what it could not keep to page.note. For film.json, lottie.lua of the program gets what it
--- needs of a script and of a program.
local page, script, path, width, height = ...

if path == "film.svg" then return page.svg(path, width, height) end
if path == "film.plane" then return page.plane(path) end

local program = { script = function() return script end, png = page.png }
function program.part(name, ...) return page.load(name)(...) end
function program.refuse_target() end
function program.fail(_, ...) error(string.format(...), 0) end
function program.note(...) page.note(string.format(...)) end
function program.save(_, text) page.save(text) end
program.part("program.lua", program)

function script.at(_, number) return page.at(number) end
script.scene = page.scene
function script:view_size() return table.unpack(self.size) end
function script:numbers()
  local list = {}
  for i = 1, self.frames do list[i] = self.first + i - 1 end
  return list
end
program.part("lottie.lua", program, { output = path })
