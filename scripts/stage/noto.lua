--- Words in Noto Sans, which Debian installs as fonts-noto-core; `weight` names the file.
return function(fields)
  local weight = fields.weight or "Regular"
  fields.font = "/usr/share/fonts/truetype/noto/NotoSans-" .. weight .. ".ttf"
  fields.weight = nil
  fields.fill = fields.fill or "#20242e"
  return text(fields)
end
