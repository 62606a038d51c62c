// Lint the page: types are read, so that a promise nobody waits for is an error.
import hooks from "eslint-plugin-react-hooks";
import tseslint from "typescript-eslint";

export default tseslint.config(
  // The worklet runs in the audio thread, without types.
  { ignores: ["dist", "node_modules", "eslint.config.js", "**/*.worklet.js"] },
  ...tseslint.configs.strictTypeChecked,
  {
    languageOptions: {
      parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname },
    },
    plugins: { "react-hooks": hooks },
    rules: {
      // Not the plugin's rules for React's compiler: signals are written to, that is their purpose.
      "react-hooks/rules-of-hooks": "error",
      "react-hooks/exhaustive-deps": "error",
      "no-console": "error",
      "no-restricted-properties": [
        "error",
        { property: "innerHTML", message: "Text is text: use textContent or JSX." },
        { property: "outerHTML", message: "Text is text: use textContent or JSX." },
        {
          property: "insertAdjacentHTML",
          message: "Text is text: use textContent or JSX.",
        },
      ],
      "no-restricted-syntax": [
        "error",
        {
          selector: "JSXAttribute[name.name='dangerouslySetInnerHTML']",
          message: "Text is text.",
        },
      ],
      "@typescript-eslint/no-confusing-void-expression": ["error", { ignoreArrowShorthand: true }],
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
      // Frames come from outside: a check that the types call needless may be what saves the page.
      "@typescript-eslint/no-unnecessary-condition": "off",
    },
  },
);
