--- celspan spec -- FILE [PATTERN]: one spec file in busted, for `celspan test`.
--
-- Each test leaves a record on descriptor 3, "KIND SECONDS LENGTH LENGTH\n" and two texts of these
-- lengths, the name and what is printed of the test:
--
--   pass ""      skip "name"      fail "name (file:line)" and the message, indented
--
-- The last record is of the kind "done".
--
-- busted is found where Lua 5.4 looks for modules.
local program, request = ...
local native = require "celspan.native"

local SCRIPT = 3 -- the exit code

local path, only = request.arguments[1], request.arguments[2]
local records = assert(io.open("/dev/fd/3", "ab"))

local begun = 0 -- when the present test began

local function record(kind, name, text)
  local head = ("%s %.6f %d %d\n"):format(kind, program.clock() - begun, #name, #text)
  assert(records:write(head, name, text))
  assert(records:flush())
end

--- The film project is the folder of the spec; if this is called "spec", the folder around it.
local function add_project(folder)
  package.path = ("%s/?.lua;%s/?/init.lua;%s"):format(folder, folder, package.path)
end
local more = os.getenv "CELSPAN_PATH"
if more and more ~= "" then package.path = more .. ";" .. package.path end
local folder = path:match "^(.*)/[^/]*$" or "."
add_project(folder:match "^(.*)/[^/]*$" or folder:sub(1, 1) ~= "/" and folder ~= "." and "."
  or folder)
add_project(folder)

local function text_of(message)
  if type(message) == "string" then return message end
  return message == nil and "no message" or require "pl.pretty".write(message)
end

local function indented(text) return (("\n" .. text):gsub("\n", "\n    ")) end

--- A failure: the test, its place, and the message.
local function failure(formatted)
  local trace = formatted.trace or {}
  local message = text_of(formatted.message)
  local place = ("%s:%d: "):format(trace.short_src or path, trace.currentline or 0)
  if message:sub(1, #place) == place then message = message:sub(#place + 1) end
  local name = formatted.name or path
  record("fail", name, ("%s (%s)%s"):format(name, place:sub(1, -3), indented(message)))
end

package.preload["busted.outputHandlers.celspan"] = function()
  return function()
    local busted = require "busted"
    local handler = require "busted.outputHandlers.base"()
    busted.subscribe({ "test", "start" }, function()
      begun = program.clock()
      return nil, true
    end)
    busted.subscribe({ "test", "end" }, function(element, _, status)
      if status == "success" then
        record("pass", handler.getFullName(element), "")
      elseif status == "pending" then
        local pending = handler.pendings[#handler.pendings]
        record("skip", pending.name, pending.name
          .. (pending.message and ": " .. text_of(pending.message) or ""))
      elseif status == "failure" then
        failure(handler.failures[#handler.failures])
      else
        failure(handler.errors[#handler.errors])
      end
      return nil, true
    end, { predicate = handler.cancelOnPending })
    busted.subscribe({ "error" }, function(element)
      if element.descriptor ~= "it" then failure(handler.errors[#handler.errors]) end
      return nil, true
    end)
    busted.subscribe({ "exit" }, function()
      record("done", "", "")
      return nil, true
    end)
    return handler
  end
end

program.give_settings()
program.default_signals()
native.open_names()
_G.arg = { [0] = "celspan test", "--ignore-lua", "--output=celspan", "--pattern=.", path }
if only then table.insert(_G.arg, 1, "--filter=" .. only) end
local good, trace = xpcall(function() require "busted.runner" { standalone = false } end,
  debug.traceback)
if not good then
  io.stderr:write(trace, "\n")
  return SCRIPT
end
