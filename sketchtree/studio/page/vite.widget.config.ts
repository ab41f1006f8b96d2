// How is the notebook's widget built? The same modules as the page, as one file that holds its styles too: dist/widget.js.

import { defineConfig } from "vite";

export default defineConfig({
  publicDir: false,
  define: { "process.env.NODE_ENV": JSON.stringify("production") },
  build: {
    outDir: "dist",
    emptyOutDir: false,
    target: "es2022",
    lib: { entry: "src/widget.ts", formats: ["es"], fileName: () => "widget.js" },
    chunkSizeWarningLimit: 1500,
  },
});
