--- Whole files: reads them up to a limit, and writes them so that only complete files appear.
--- A pipe or a device is refused, and not waited for.
local native = require "celspan.native"

local files = {}

local MOST_BYTES = 256 * 1024 * 1024 -- of a file that a script reads as text
files.MOST_CAPTIONS = 64 * 1024 * 1024 -- bytes of a file of captions

--- The text of a regular file.
---@param path string
---@param most integer Bytes
---@return string? text
---@return string? message
function files.read(path, most) return native.file_text(path, most) end

--- Reads a file named in a script, which is beside the caller's file, or else beside the script.
--- read(path, ...): returns what it has read, or nil and a message.
function files.found(path, read, ...)
  local found_at, tried = native.find(path)
  local value, message = read(found_at, ...)
  if value or not tried then return value, message end
  return nil, ("%s; also looked for at %s"):format(message, tried)
end

--- The text of a file named in a script.
---@param path string
---@param most integer Bytes
---@return string? text
---@return string? message
function files.read_found(path, most) return files.found(path, files.read, most) end

--- celspan.read: the text of a file named in a script.
function files.text(path)
  if type(path) ~= "string" then
    native.refuse("celspan: read takes a file name, got " .. type(path))
  end
  return files.read_found(path, MOST_BYTES)
end

---@param path string Relative to the current folder
---@param text string
---@return true? done
---@return string? message
function files.write(path, text)
  local part = path .. ".part"
  local file, message = io.open(part, "wb")
  if not file then return nil, message end
  local good, problem = file:write(text)
  local closed, unclosed = file:close()
  if not good or not closed then
    os.remove(part)
    return nil, ("%s: %s"):format(path, problem or unclosed)
  end
  good, problem = os.rename(part, path)
  if not good then os.remove(part) end
  return good, problem
end

return require "celspan.fields".publish("files", files)
