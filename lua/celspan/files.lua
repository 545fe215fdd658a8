--- Files as a whole: read up to a limit, and written so that they appear whole or not at all.
local core = require "celspan.core"

local files = {}

---@param path string
---@param most integer Bytes
---@return string? text
---@return string? message
function files.read(path, most)
  local file, message = io.open(path, "rb")
  if not file then return nil, message end
  local text, problem = file:read(most + 1)
  file:close()
  if problem then return nil, ("%s: %s"):format(path, problem) end
  text = text or "" -- of an empty file
  if #text > most then
    return nil, ("%s: it has more than %d bytes, which is the limit"):format(path, most)
  end
  return text
end

--- The same of a file that a script names: beside the caller's file, else beside the script.
---@param path string
---@param most integer Bytes
---@return string? text
---@return string? message
function files.read_found(path, most)
  local found_at, tried = core.find(path)
  local text, message = files.read(found_at, most)
  if text or not tried then return text, message end
  return nil, ("%s; nor is it there: %s"):format(message, tried)
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

return require "celspan.fields".seal("files", files)
