// Rules of scripts/lint for the pages' scripts: faults, not taste.
import js from '@eslint/js';

const browser = Object.fromEntries(['addEventListener', 'atob', 'Blob', 'DecompressionStream', 'devicePixelRatio', 'document', 'Event', 'EventTarget',
  'getComputedStyle', 'location', 'matchMedia', 'Node', 'performance', 'requestAnimationFrame', 'ResizeObserver', 'Response', 'setTimeout', 'TextDecoder', 'window',
].map((name) => [name, 'readonly']));
const node = { Buffer: 'readonly', process: 'readonly' };

export default [
  js.configs.recommended,
  {
    languageOptions: { globals: browser },
    rules: {
      'no-unused-vars': ['error', { argsIgnorePattern: '^_' }],
      'no-var': 'error', 'prefer-const': 'error', eqeqeq: 'error', 'no-shadow': 'error',
      semi: 'error', quotes: ['error', 'single', { avoidEscape: true, allowTemplateLiterals: true }], 'comma-dangle': ['error', 'only-multiline'], 'max-len': ['error', 180],
    },
  },
  { files: ['build.mjs', 'eslint.config.js'], languageOptions: { globals: node } },
];
