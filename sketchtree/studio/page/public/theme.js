// Which theme is the first paint in? The one that was chosen in this browser, else the system's: before the page's own program is here (src/style/theme.ts follows it).
{
  const kept = localStorage.getItem("sketchtree-theme");
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = kept === "light" || kept === "dark" ? kept : dark ? "dark" : "light";
}
