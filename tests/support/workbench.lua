--- A folder for one test of the command line: its files, and commands to run there.
local system = require "tests.support.system"

local BINARY = os.getenv "CELSPAN" or "build/celspan"
local BUILD = os.getenv "CELSPAN_BUILD" or "build"

--- The path, valid from any folder.
local function absolute(path)
  return path:sub(1, 1) == "/" and path or os.getenv "PWD" .. "/" .. path
end

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

--- The contents of a file, by its name in the folder or an absolute path; nil if it does not exist.
function workbench:read(name)
  return (system.read(name:sub(1, 1) == "/" and name or self.folder .. "/" .. name))
end

--- Writes a file; returns its path.
function workbench:write(name, text)
  local path = self.folder .. "/" .. name
  system.write(path, text)
  return path
end

--- The names in a folder of the bench, including hidden ones, sorted; none if the folder does not
--- exist.
function workbench:files(name)
  return (system.lines(("ls -A '%s/%s' 2>/dev/null"):format(self.folder, name or "")))
end

--- Runs a shell command. Returns its exit code (128 + n for signal n), standard output and standard
--- error.
function workbench:shell(command)
  local out, err = self.folder .. "/stdout", self.folder .. "/stderr"
  local _, how, code = os.execute(("( %s ) >'%s' 2>'%s'"):format(command, out, err))
  return how == "signal" and 128 + code or code, self:read(out), self:read(err)
end

--- The same, in the folder.
function workbench:inside(command)
  return self:shell(("cd '%s' && %s"):format(self.folder, command))
end

--- A command of celspan. A leak check attaches to the process from another one, which --strict does
--- not allow.
local function command_of(program, arguments, ...)
  local words = arguments:format(...)
  local before = words:find("--strict", 1, true)
    and "ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 " or ""
  return ("%s'%s' %s"):format(before, program, words)
end

--- Runs celspan with arguments, which are a format for string.format.
function workbench:celspan(arguments, ...)
  return self:shell(command_of(BINARY, arguments, ...))
end

--- The same, in the folder.
function workbench:celspan_inside(arguments, ...)
  return self:inside(command_of(workbench.absolute, arguments, ...))
end

--- Renders film.lua, which is written first, without its progress; that must succeed. Returns what
--- was said.
function workbench:rendered(script, arguments)
  self:write("film.lua", script)
  local code, _, err = self:celspan_inside("render film.lua --progress none %s", arguments)
  assert(code == 0, err)
  return err
end

--- The same for arguments of any verb: returns the code, what was said and what was printed.
function workbench:ran(arguments)
  local code, out, err = self:celspan_inside("%s", arguments)
  return code, err, out
end

workbench.binary = BINARY
--- The program and the folder of the build, from any folder.
workbench.absolute = absolute(BINARY)
workbench.build = absolute(BUILD)

return workbench
