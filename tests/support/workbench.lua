--- A folder for one test of the command line: files in it, and commands run beside it.
local BINARY = os.getenv "CELSPAN" or "build/celspan"
local BUILD = os.getenv "CELSPAN_BUILD" or "build"

--- The same from any folder.
local function absolute(path) return path:sub(1, 1) == "/" and path or os.getenv "PWD" .. "/" .. path end

local workbench = {}
workbench.__index = workbench

--- A new, empty folder; bench.folder is its path.
function workbench.new()
  local folder = os.tmpname()
  os.remove(folder)
  assert(os.execute("mkdir '" .. folder .. "'"))
  return setmetatable({ folder = folder }, workbench)
end

function workbench:remove() os.execute("rm -rf '" .. self.folder .. "'") end

--- The whole of a file, by its name in the folder or an absolute path; nil when there is none.
function workbench:read(name)
  local file = io.open(name:sub(1, 1) == "/" and name or self.folder .. "/" .. name, "rb")
  if not file then return nil end
  local text = file:read("a")
  file:close()
  return text
end

--- Writes a file; answers its path.
function workbench:write(name, text)
  local path = self.folder .. "/" .. name
  local file = assert(io.open(path, "wb"))
  file:write(text)
  file:close()
  return path
end

--- The names in a folder of the bench, hidden ones too, sorted; none when there is no such folder.
function workbench:files(name)
  local names = {}
  local list = assert(io.popen(("ls -A '%s/%s' 2>/dev/null"):format(self.folder, name or "")))
  for found in list:lines() do names[#names + 1] = found end
  list:close()
  return names
end

--- Runs a shell command; its exit code (128 + n for signal n), standard output and error.
function workbench:shell(command)
  local out, err = self.folder .. "/stdout", self.folder .. "/stderr"
  local _, how, code = os.execute(("( %s ) >'%s' 2>'%s'"):format(command, out, err))
  return how == "signal" and 128 + code or code, self:read(out), self:read(err)
end

--- Runs celspan with arguments, which are a format for string.format.
function workbench:celspan(arguments, ...)
  return self:shell(BINARY .. " " .. arguments:format(...))
end

workbench.binary = BINARY
--- The program and the folder of the build, from any folder.
workbench.absolute = absolute(BINARY)
workbench.build = absolute(BUILD)

return workbench
