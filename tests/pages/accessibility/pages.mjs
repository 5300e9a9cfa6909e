import { half } from '../driver/axe-pages.mjs';

export default half(0);
