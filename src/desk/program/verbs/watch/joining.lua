--- The modules of the page of celspan watch as one script, because a browser that asks for one
--- module after the other shows its first picture late.
--
--   page.js --imports--> the modules, each after those that it imports --> one text
--
-- The modules share one scope in it: no two of them have a name of their own in common, and none
-- imports a name as another. tests/support/modules.lua checks both.
local joining = {}

--- A script or a style sheet without comments and indentation.
function joining.bare(text)
  return (("\n" .. text):gsub("\n%s*/%*.-%*/", "\n"):gsub("\n%s*//[^\n]*", "")
    :gsub(" +// [^\n]*", ""):gsub("\n%s+", "\n"))
end

--- The names of the modules that a module needs, itself last, in the order in which a browser would
--- run them. read(name): the text of a module.
function joining.order(name, read, order)
  order = order or {}
  if order[name] then return order end
  order[name] = true
  for import in read(name):gmatch '\nimport [^;]- from "/([%w.]+)";' do
    joining.order(import, read, order)
  end
  order[#order + 1] = name
  return order
end

--- The script of a module and of all that it needs.
function joining.join(name, read)
  local texts = {}
  for i, one in ipairs(joining.order(name, read)) do
    texts[i] = joining.bare(read(one)):gsub("\nimport [^;]*;", ""):gsub("\nexport ", "\n")
  end
  return table.concat(texts)
end

return joining
