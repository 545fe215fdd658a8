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

--- A text of the page as it is sent. Scripts and styles travel without comments and indentation,
--- and styles without most blanks: so they have two fifths fewer bytes. No text in a style may have
--- a blank after a colon or a comma.
function joining.text(name, read)
  local ending = name:match "%w+$"
  if ending == "js" then return joining.join(name, read) end
  local text = ending == "html" and read(name) or joining.bare(read(name))
  return ending == "css" and text:gsub("%s*([{};])%s*", "%1"):gsub("([:,]) ", "%1") or text
end

return joining
