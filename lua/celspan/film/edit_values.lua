--- Values of files about edits, which anybody may have written. A failure is a table with a
--- message, for fields.caught.
local fields = require "celspan.fields"
local json = require "celspan.json"

local edit_values = {}

function edit_values.fail(...) error({ message = string.format(...) }, 0) end

function edit_values.table_of(value) return type(value) == "table" and value or {} end

--- A text that is not empty, or nil.
function edit_values.text_of(value)
  return type(value) == "string" and value ~= "" and value or nil
end

--- A number between bounds. default: instead of one that is missing.
function edit_values.number_of(value, what, least, most, default)
  if value == nil or value == json.null then value = default end
  if not fields.is_finite(value) or value < least or value > most then
    edit_values.fail("%s must be a number from %g to %g, got %s", what, least, most,
      fields.shown(value))
  end
  return value
end

--- Adds a sentence to the list `skipped` of an edit.
function edit_values.skip(edit, ...) table.insert(edit.skipped, string.format(...)) end

return fields.seal("edit_values", edit_values)
