import { defineConfig } from 'vite';

// The built page is one folder that a server hands out as it is; FASTBALL_PAGE_DIR names it.
export default defineConfig({
  base: './',
  build: {
    outDir: process.env.FASTBALL_PAGE_DIR ?? 'dist',
    emptyOutDir: true,
    target: 'es2022',
    chunkSizeWarningLimit: 900,
    modulePreload: { polyfill: false },
  },
});
