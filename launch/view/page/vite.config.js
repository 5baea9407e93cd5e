import { readFileSync } from 'node:fs';
import { defineConfig } from 'vite';

/** The licences of the libraries in the bundle, as a file beside it. */
const licences = {
  name: 'licences',
  generateBundle() {
    const texts = ['three', 'uplot'].map(
      (library) => `${library}\n\n${readFileSync(`node_modules/${library}/LICENSE`, 'utf8')}`,
    );
    this.emitFile({ type: 'asset', fileName: 'licences.txt', source: texts.join('\n\n') });
  },
};

// The built page is one folder that a server hands out as it is; FASTBALL_PAGE_DIR names it.
export default defineConfig({
  base: './',
  plugins: [licences],
  build: {
    outDir: process.env.FASTBALL_PAGE_DIR ?? 'dist',
    emptyOutDir: true,
    target: 'es2022',
    chunkSizeWarningLimit: 900,
    modulePreload: { polyfill: false },
  },
});
