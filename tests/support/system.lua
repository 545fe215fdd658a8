--- Files, and the output of shell commands.
local system = {}

--- The whole of a file; nil and a message when it cannot be read.
function system.read(path)
  local file, message = io.open(path, "rb")
  if not file then return nil, message end
  local text
  text, message = file:read "a"
  file:close()
  return text, message
end

function system.write(path, text)
  local file = assert(io.open(path, "wb"))
  assert(file:write(text))
  assert(file:close())
end

function system.exists(path)
  local file = io.open(path, "rb")
  if file then file:close() end
  return file ~= nil
end

--- A word, quoted for a shell command.
function system.quote(word) return "'" .. tostring(word):gsub("'", "'\\''") .. "'" end

--- The output of a shell command, and whether it succeeded.
function system.output(command)
  local pipe = assert(io.popen(command))
  local text = pipe:read "a"
  return text, pipe:close() == true
end

--- The lines of the output, and whether it succeeded.
function system.lines(command)
  local lines, pipe = {}, assert(io.popen(command))
  for line in pipe:lines() do lines[#lines + 1] = line end
  return lines, pipe:close() == true
end

return system
