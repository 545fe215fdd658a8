--- Where the reader is in a file, for what it leaves out.
--
--   layers[3].shapes[0] 'star': zig zag are left out
local values = require "celspan.lottie_values"

local scope = {}

local MOST_NOTES = 1000

local Scope = {}
Scope.__index = Scope

local function child(parent, path, name)
  local made = setmetatable({ root = parent.root, path = parent.path .. path,
                              name = values.text(name) or parent.name }, Scope)
  made.note = function(what) made:add(what) end
  made.within = function(suffix, own) return child(made, suffix, own) end
  return made
end

--- Adds a line to `skipped`, once.
function Scope:add(what)
  local list, seen = self.root.skipped, self.root.seen
  local name = self.name and self.name ~= "" and (" '%s'"):format(values.name(self.name, "")) or ""
  local line = self.path == "" and what or ("%s%s: %s"):format(self.path, name, what)
  if seen[line] or #list > MOST_NOTES then return end
  seen[line] = true
  list[#list + 1] = #list < MOST_NOTES and line or "and more, which are not listed"
end

--- The scope of a file. root: slots, skipped and what else its parts share.
---@param root table
function scope.new(root)
  root.seen = {}
  return child({ root = root, path = "" }, "")
end

return require "celspan.fields".seal("lottie_scope", scope)
