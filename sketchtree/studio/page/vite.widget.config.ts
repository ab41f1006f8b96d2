// How is the notebook's widget built? The same modules as the page, as one file that holds its styles too (widget.css, inline): dist/widget.js.

import { defineConfig, type Plugin } from "vite";

/** Style sheets that modules import for the studio's page are in widget.css already. */
const noSheets: Plugin = {
  name: "no-sheets",
  generateBundle: {
    order: "post",
    handler(_options, bundle) {
      for (const name of Object.keys(bundle)) if (name.endsWith(".css")) delete bundle[name];
    },
  },
};

export default defineConfig({
  publicDir: false,
  plugins: [noSheets],
  define: { "process.env.NODE_ENV": JSON.stringify("production") },
  build: {
    outDir: "dist",
    emptyOutDir: false,
    target: "es2022",
    lib: { entry: "src/widget.ts", formats: ["es"], fileName: () => "widget.js" },
    chunkSizeWarningLimit: 1500,
  },
});
