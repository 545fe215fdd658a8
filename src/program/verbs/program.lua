--- What every verb in Lua uses: the services of service.c, and the functions added to them here.
local program = ...

local fail, note, report = program.fail, program.note, program.error

--- "celspan: ..." on standard error.
function program.note(...) note(string.format(...)) end

--- "celspan: error: ..." on standard error; the verb continues.
function program.error(...) report(string.format(...)) end

--- Reports an error and ends the verb. kind: "usage", "script", "input", "output" or "limit".
function program.fail(kind, ...) fail(kind, string.format(...)) end

function program.usage(...) program.fail("usage", ...) end

--- Whether a path has one of these endings, in upper or lower case.
function program.has_ending(path, ...)
  for _, ending in ipairs { ... } do
    if #path > #ending and path:sub(-#ending):lower() == ending then return true end
  end
  return false
end

--- The parts of a text between commas.
function program.split(text)
  local list = {}
  for part in (text .. ","):gmatch "([^,]*)," do list[#list + 1] = part end
  return list
end

--- The pigment of an opaque colour such as "#ffe0b0"; nil for another text.
function program.colour(text)
  local good, paint = pcall(require "celspan".rgb, text:match "^#.*")
  return good and paint.beta == 1 and paint.pigment or nil
end

--- The whole numbers in a text such as "1,2,30,40".
function program.numbers(text)
  local list = {}
  for number in text:gmatch "[+-]?%d+" do list[#list + 1] = math.tointeger(number) end
  return list
end

--- Has a document write itself to a file, or its text to standard output. subject: what it was made
--- from, for messages.
function program.put(document, output, subject)
  if output and output ~= "-" then
    program.make_folders(output)
    local done, message = document:write(output)
    return done or program.fail("output", "%s", message)
  end
  local text, message = document:text()
  if not text then program.fail("limit", "%s: %s", subject, message) end
  io.stdout:write(text)
end
